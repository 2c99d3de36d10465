"""``roslens reference draft``: what a reference for a recording, or for what runs now, could say."""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

from roslens.cli.boundary import CLEAN, NOT_ANALYSED
from roslens.model.errors import UsageError

TEXT = "Draft a reference from a recording or from what runs now, each line with what speaks for it."
_NAME = re.compile(r"[a-z][a-z0-9_-]*\Z")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is drafted from and where it goes."""
    parser.add_argument("--bag", type=Path, nargs="+", metavar="FILE", required=True, help="a recording")
    parser.add_argument("--name", default="draft", help="of the reference (default: draft)")
    parser.add_argument("--each", action="store_true", help="a line for each topic, also where several are alike")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="write it there (default: standard output)")
    parser.set_defaults(act=draft)


def draft(options: argparse.Namespace) -> int:
    """Write the draft and return the exit code: 3 where parts of the recording could not be read.

    Raises:
        UsageError: there is no recording, the name is none, or the file exists.
    """
    from roslens.live.adapters.bag.open_bag import open_bag
    from roslens.live.draft import Observed
    from roslens.live.draft_groups import grouped
    from roslens.live.draft_text import draft_text

    if not _NAME.match(options.name):
        raise UsageError(f"--name {options.name!r}", expected="small letters, digits, `-` and `_`, a letter first")
    if options.output is not None and options.output.exists():
        raise UsageError(
            f"{str(options.output)!r} exists", expected="a new file", advice="Remove it, or choose another"
        )
    bag = open_bag(options.bag)
    observed = Observed()
    observed.add_types((topic.name, topic.type) for topic in bag.topics)
    for _, tallies in bag.tallies(observed.step_s):
        observed.add(tallies)
    drafts = observed.drafted() if options.each else grouped(observed.drafted())
    source = (
        ", ".join(path.name for path in options.bag) + f" ({bag.messages:,} messages in {bag.end - bag.start:.0f} s)"
    )
    text = draft_text(options.name, drafts, observed.left_out(), source)
    if options.output is None:
        print(text, end="")
    else:
        options.output.write_text(text, encoding="utf-8")
        print(f"roslens: wrote {options.output}; read it and change it before you rely on it", file=sys.stderr)
    for failure in bag.failures:
        print(f"roslens: {failure}", file=sys.stderr)
    return NOT_ANALYSED if bag.failures else CLEAN
