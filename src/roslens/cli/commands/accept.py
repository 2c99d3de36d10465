"""``roslens accept``: keep that findings were looked at and stay, in a file of the repository."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from roslens.model.finding import Finding
    from roslens.source.workspace.acceptances import Acceptance
    from roslens.store.read import RunView

TEXT = "Accept findings, or mark them as false positives, in roslens.accepted.toml."
EXAMPLES = """\
  roslens accept 3f2a9c0d --reason "the buffer is sized by the caller"
  roslens accept src/drive.cpp:12 --false-positive --reason "x is never null here"
  roslens accept 'ros.calls.max@src/legacy/*' --reason "legacy, frozen"
  roslens accept --list
  roslens accept --undo 3f2a9c0d"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is accepted and why."""
    parser.add_argument(
        "ids",
        nargs="*",
        metavar="ID",
        help="findings of the last run: a fingerprint or the beginning of one (6 digits or more), FILE:LINE, or "
        "RULE@GLOB for those of a rule in files",
    )
    parser.add_argument("--path", default=".", metavar="PATH", help="the workspace that was checked (default: .)")
    parser.add_argument("--reason", metavar="TEXT", help="the reason, for reviewers of the file")
    parser.add_argument(
        "--false-positive", action="store_true", help="the finding is a false positive (default: true, and accepted)"
    )
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--list", action="store_true", help="list accepted findings")
    what.add_argument("--undo", action="store_true", help="remove entries, by fingerprint or its first digits")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")


def run(options: argparse.Namespace) -> int:
    """Change or show the file.

    Raises:
        UsageError: nothing is meant by an id, there is no reason, or the file is wrong.
    """
    from roslens.cli.workplace.accepted_file import accepted_file_of, entries_of, write_entries
    from roslens.model.errors import UsageError

    place = accepted_file_of(_root(options.path), options.config)
    entries = entries_of(place)
    if options.list:
        _show(entries)
        return 0
    if not options.ids:
        raise UsageError("no findings are named", expected="fingerprints, FILE:LINE or RULE@GLOB, or --list")
    kept = _without(entries, options.ids) if options.undo else _with(entries, options)
    write_entries(place, kept)
    if kept:
        print(f"wrote {place}")
    return 0


def _root(start: str) -> Path:
    from pathlib import Path

    from roslens.cli.workplace.workplace import some_folder

    folder = some_folder(start)
    return folder.parent if folder else Path(start).resolve()


def _show(entries: tuple[Acceptance, ...]) -> None:
    for one in entries:
        print(f"{one.fingerprint}  {one.state.value:14}  {one.rule}  {one.path}")
        print(f"    {one.reason}")
    print(f"{len(entries)} accepted")


def _without(entries: tuple[Acceptance, ...], ids: list[str]) -> list[Acceptance]:
    from roslens.model.errors import UsageError

    gone: set[str] = set()
    for given in ids:
        meant = [one.fingerprint for one in entries if one.fingerprint.startswith(given)]
        if len(set(meant)) != 1:
            raise UsageError(
                f'"{given}" is the beginning of {len(set(meant))} accepted fingerprints',
                expected="the beginning of one",
                advice="`roslens accept --list` shows them",
            )
        gone.update(meant)
    print(f"{len(gone)} taken back")
    return [one for one in entries if one.fingerprint not in gone]


def _with(entries: tuple[Acceptance, ...], options: argparse.Namespace) -> list[Acceptance]:
    from roslens.cli.workplace.accepted_file import with_findings
    from roslens.cli.workplace.workplace import open_store
    from roslens.model.errors import UsageError
    from roslens.model.set_aside import Disposition

    reason = " ".join((options.reason or "").split())
    if not reason:
        raise UsageError("no reason is given", expected='--reason "why the finding stays"')
    state = Disposition.FALSE_POSITIVE if options.false_positive else Disposition.ACCEPTED
    with open_store(options.path) as store:
        view = store.view(None)
        chosen = {one.fingerprint: one for given in options.ids for one in _meant(given, view)}
    print(f"{len(chosen)} {'called false positives' if options.false_positive else 'accepted'}; check again to see it")
    return with_findings(entries, chosen.values(), reason, state)


_LEAST = 6


def _meant(given: str, view: RunView) -> list[Finding]:
    """Return the findings that an id means.

    Raises:
        UsageError: it means none, or the beginning of a fingerprint is not clear.
    """
    from fnmatch import fnmatchcase

    from roslens.model.errors import UsageError
    from roslens.source.workspace.suppress import names

    rule, at, glob = given.partition("@")
    path, _, line = given.rpartition(":")
    if at:
        found = [
            one
            for one in view.findings()
            if names(rule, one.rule, one.tags) and fnmatchcase(one.path or one.entity, glob)
        ]
    elif line.isdigit() and path:
        found = [one for one in view.findings(path=path.removeprefix("./")) if one.line == int(line)]
    else:
        known = [one for one in view.findings() if given and one.fingerprint.startswith(given)]
        found = known if len(given) >= _LEAST else []
        if len({one.fingerprint for one in found}) > 1:
            raise UsageError(
                f'"{given}" is the beginning of {len(found)} fingerprints', expected="more of the digits of one"
            )
    if not [one for one in found if one.fingerprint]:
        raise UsageError(
            f'"{given}" means no finding of the last run',
            expected=f"a fingerprint ({_LEAST} digits or more), FILE:LINE or RULE@GLOB",
            advice="`roslens check --format json` shows the fingerprints; run it first if the source changed",
        )
    return [one for one in found if one.fingerprint]
