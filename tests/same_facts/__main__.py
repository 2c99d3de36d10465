"""``python -m same_facts BASE``: compares what a revision and the working tree say of the repositories of the list.

Exit codes: 0 nothing differs, 1 something does, 2 wrong usage, 3 something could not be compared.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from fnmatch import fnmatch
from pathlib import Path

from same_facts.comparing import Difference, differences
from same_facts.sides import KEPT, NoRevisionError, Side, ask, revision, wanted, working_tree, workspaces

SAME, DIFFERENT, WRONG, NOT_COMPARED = 0, 1, 2, 3
SHOWN = 300
"""Characters of a value."""


def say(line: str) -> None:
    """Tell how it goes."""
    sys.stderr.write(line + "\n")


def shown(repository: str, one: Difference) -> str:
    """Return a difference as a line for each value."""
    values = (text if len(text) <= SHOWN else f"{text[:SHOWN]}…" for text in (one.before, one.after))
    before, after = values
    return f"{repository}: {one.entity}: {one.field}\n  - {before}\n  + {after}"


def compare(before: Side, after: Side, names: list[str]) -> tuple[int, list[str]]:
    """Print the differences of what two revisions said; return how many there are and what neither could be asked."""
    count, broken = 0, []
    for name in sorted(names):
        texts = [(side.out / f"{name}.json").read_bytes() for side in (before, after)]
        first, second = map(json.loads, texts)
        if "broken" in first and "broken" in second:
            broken.append(name)
        for one in differences(first, second) if texts[0] != texts[1] else ():
            count += 1
            sys.stdout.write(shown(name, one) + "\n")
    return count, broken


def main(words: list[str]) -> int:
    """Ask both and compare."""
    parser = argparse.ArgumentParser(prog="python -m same_facts", description=__doc__)
    parser.add_argument("base", help="revision of git")
    parser.add_argument("--corpora", type=Path, default=os.environ.get("ROSLENS_CORPORA"), help="folder with clones")
    parser.add_argument("--only", default="*", metavar="PATTERN", help="of owner+name")
    parser.add_argument("--jobs", type=int, default=2, help="processes (default: 2)")
    options = parser.parse_args(words)
    if options.corpora is None or not Path(options.corpora).is_dir():
        say(f'"{options.corpora}" is no folder; expected --corpora or $ROSLENS_CORPORA with clones')
        return WRONG
    commits = {name: commit for name, commit in wanted().items() if fnmatch(name, options.only)}
    names, missing = workspaces(commits, Path(options.corpora))
    try:
        sides = (revision(options.base), working_tree())
    except NoRevisionError as error:
        say(str(error))
        return WRONG
    for side in sides:
        began = time.monotonic()
        asked = 0
        for line in ask(side, names, jobs=options.jobs):
            say(line)
            asked += 1
        took = time.monotonic() - began
        say(f"{side.name}: {asked} asked in {took:.0f} s, {len(names) - asked} known before")
    count, broken = compare(*sides, names)
    lacking = [f"no clone of {name} with its commit" for name in missing]
    lacking += [f"both revisions break at {name}" for name in broken]
    for line in lacking:
        sys.stdout.write(f"not compared: {line}\n")
    compared = len(names) - len(broken)
    sys.stdout.write(f"{count} differences in {compared} repositories; what was said is in {KEPT / 'told'}\n")
    if count:
        return DIFFERENT
    return NOT_COMPARED if lacking or not names else SAME


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
