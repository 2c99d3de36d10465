"""Findings accepted on the pages of a run, in the file that `roslens accept` writes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from roslens.cli.workplace.accepted_file import accepted_file_of, entries_of, with_findings, write_entries
from roslens.dashboard.review import Reviewed
from roslens.model.errors import RoslensError, UsageError
from roslens.model.finding import Finding
from roslens.model.set_aside import Disposition
from roslens.source.engines.watched_reader import LostReaderError, read_watched
from roslens.source.workspace.acceptances import Acceptance

MOST_HERE = 1_000_000
"""Bytes of a file that is read in this process, which answers meanwhile: more can take seconds, and gigabytes."""


def _entries_of(place: Path) -> tuple[Acceptance, ...]:
    try:
        if place.stat().st_size <= MOST_HERE:
            return entries_of(place)
    except OSError:
        return entries_of(place)
    try:
        return read_watched("", entries_of, place)
    except LostReaderError as error:
        raise UsageError(
            f"{place}: {error}", expected="TOML with [[accepted]] tables", advice="Fix the file"
        ) from error


class Reviewing:
    """One file, read again when it has changed."""

    def __init__(self, place: Path, findings: Callable[[], Iterable[Finding]]) -> None:
        """``findings`` yields those of the run that is shown."""
        self._place = place
        self._findings = findings
        self._stamp: tuple[int, int] | None = None
        self._entries: dict[str, Reviewed] = {}

    def entries(self) -> Mapping[str, Reviewed]:
        """Return the current content of the file; nothing if it cannot be read, which a check reports."""
        try:
            found = self._place.stat()
            stamp = found.st_mtime_ns, found.st_size
        except OSError:
            stamp = 0, 0
        if stamp != self._stamp:
            self._stamp = stamp
            try:
                known = _entries_of(self._place)
            except RoslensError:
                known = ()
            self._entries = {
                one.fingerprint: Reviewed(
                    one.fingerprint, one.state.value, one.reason, one.rule, one.path, one.message
                )
                for one in known
            }  # fmt: skip
        return self._entries

    def accept(self, fingerprint: str, reason: str, *, false_positive: bool) -> str:
        """Write that a finding of the run stays; return why not, if not."""
        meant = [one for one in self._findings() if fingerprint and one.fingerprint == fingerprint]
        if not meant:
            return f"{fingerprint[:40]!r} is the fingerprint of no finding of this run."
        state = Disposition.FALSE_POSITIVE if false_positive else Disposition.ACCEPTED
        try:
            write_entries(self._place, with_findings(_entries_of(self._place), meant[:1], reason, state))
        except (RoslensError, OSError) as error:
            return f"{self._place}: {error}"
        return ""

    def undo(self, fingerprint: str) -> str:
        """Take that back; return why not, if not."""
        try:
            entries = _entries_of(self._place)
            kept = [one for one in entries if one.fingerprint != fingerprint]
            if len(kept) == len(entries):
                return f"{fingerprint[:40]!r} is the fingerprint of nothing that is accepted."
            write_entries(self._place, kept)
        except (RoslensError, OSError) as error:
            return f"{self._place}: {error}"
        return ""


def reviewing_of(root: Path, findings: Callable[[], Iterable[Finding]]) -> Reviewing | None:
    """Return what changes the file of a workspace; None where its configuration cannot be read."""
    try:
        return Reviewing(accepted_file_of(root), findings)
    except RoslensError:
        return None
