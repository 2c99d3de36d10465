"""What the page of a journal shows: entries as rows, newest first, and whether they are as they were written."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import msgspec

from roslens.model.errors import StoreError
from roslens.report.history.journal_text import action_text, because_text, rest_text
from roslens.store.journals.journal_entry import Entry
from roslens.store.journals.read_journal import JournalReader, Verified, verify

PAGE = 200
"""Entries at a time."""
MOST_KEPT = 20_000
"""Entries that can be looked at on the page; `roslens journal` shows all."""
_LARGE = 4_000_000
_VERIFY_LARGE_EVERY_S = 10.0
"""The hashes of a journal of many bytes take a while."""
_BAD = frozenset(("failed", "refused", "gave-up", "held", "still there", "unknown", "refuse", "give up"))
_FIRST = ("result", "gate", "verification", "text")
_GOOD = frozenset(("done", "gone", "allow"))


class JournalRow(msgspec.Struct, frozen=True):
    """An entry as people read it.

    Attributes:
        n: number of the entry.
        time: seconds since the epoch.
        when: the same as people read it.
        what: kind of the entry.
        mark: ``ok``, ``warning`` or empty: whether it is good, bad or neither.
        decision: id of the decision, empty of none.
        entity: text form of the id of what the decision is about, empty of none.
        text: its content.
        hash: of the entry.
    """

    n: int
    time: float
    when: str
    what: str
    mark: str
    decision: str
    entity: str
    text: str
    hash: str


class JournalPart(msgspec.Struct, frozen=True):
    """A page of a journal.

    Attributes:
        rows: newest first.
        total: entries that fit the filter, of those that are kept.
        entities: that anything was decided about, for the filter.
        kinds: of entries, for the filter.
        verified: what a look at the hashes found; None where there is no journal.
        problem: why the journal cannot be read; empty where it can.
    """

    rows: tuple[JournalRow, ...] = ()
    total: int = 0
    entities: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ()
    verified: Verified | None = None
    problem: str = ""


class JournalView:
    """Reads a journal as it grows; for several threads."""

    def __init__(self, path: Path, clock: Callable[[float], str], steady: Callable[[], float] = time.monotonic) -> None:
        """Show the journal at ``path``, which may not be there yet; ``clock`` writes seconds since the epoch."""
        self.path = path
        self._clock = clock
        self._steady = steady
        self._lock = threading.Lock()
        self._reader: JournalReader | None = None
        self._stamp = (0, 0, 0)
        self._rows: list[JournalRow] = []
        self._about: dict[str, str] = {}
        self._page = ""
        self._verified: tuple[tuple[int, int, int], float, Verified] | None = None

    def version(self) -> str:
        """Return what changes with the file."""
        return "-".join(map(str, self._look()))

    def part(self, *, entity: str = "", what: str = "", text: str = "", before: int | None = None) -> JournalPart:
        """Return the newest entries that fit a filter, of those before the entry ``before`` where that is given."""
        with self._lock:
            try:
                self._read()
                verified = self._verify()
            except StoreError as error:
                return JournalPart(problem=str(error))
            words = text.casefold().split()
            fitting = [
                one for one in self._rows
                if (not entity or one.entity == entity) and (not what or one.what == what)
                and all(word in f"{one.text} {one.decision} {one.entity} {one.what}".casefold() for word in words)
            ]  # fmt: skip
            older = [one for one in fitting if before is None or one.n < before]
            return JournalPart(
                rows=tuple(reversed(older[-PAGE:])),
                total=len(fitting),
                entities=tuple(sorted({one.entity for one in self._rows if one.entity})),
                kinds=tuple(sorted({one.what for one in self._rows})),
                verified=verified,
            )

    def decided(self) -> dict[str, tuple[int, JournalRow]]:
        """Return by reaction how many decisions of it are kept, and the newest entry about one of them."""
        with self._lock:
            try:
                self._read()
            except StoreError:
                return {}
            found: dict[str, tuple[int, JournalRow]] = {}
            for one in self._rows:
                if one.decision:
                    name = one.decision.partition("/")[0]
                    count = found[name][0] if name in found else 0
                    found[name] = count + (one.what == "decided"), one
            return found

    def page(self) -> str:
        """Return where who reacts now shows its own page, with the questions that it asks; empty where nobody does."""
        with self._lock:
            try:
                self._read()
            except StoreError:
                return ""
            return self._page

    def _look(self) -> tuple[int, int, int]:
        try:
            found = self.path.stat()
        except OSError:
            return (0, 0, 0)
        return found.st_ino, found.st_size, found.st_mtime_ns

    def _read(self) -> None:
        stamp = self._look()
        # Another file in its place, or one that was cut: what was read is no part of it.
        if self._reader is not None and (stamp[0] != self._stamp[0] or stamp[1] < self._stamp[1]):
            self._reader.close()
            self._reader, self._rows, self._about, self._page = None, [], {}, ""
        if self._reader is None:
            self._reader = JournalReader(self.path)
        self._stamp = stamp
        for entry in self._reader.entries():
            self._rows.append(self._row(entry))
            if entry.what in ("began", "ended"):
                address = str(entry.fields.get("page", ""))
                self._page = address if entry.what == "began" and address.startswith(("http://", "https://")) else ""
        if len(self._rows) > 2 * MOST_KEPT:
            self._rows = self._rows[-MOST_KEPT:]
            kept = {one.decision for one in self._rows}
            self._about = {key: value for key, value in self._about.items() if key in kept}

    def _verify(self) -> Verified:
        now = self._steady()
        if self._verified is not None:
            stamp, at, found = self._verified
            if stamp == self._stamp or (self._stamp[1] > _LARGE and now - at < _VERIFY_LARGE_EVERY_S):
                return found
        found = verify(self.path)
        self._verified = self._stamp, now, found
        return found

    def _row(self, entry: Entry) -> JournalRow:
        fields = entry.fields
        decision = str(fields.get("decision", ""))
        if decision and isinstance(named := fields.get("entity"), str):
            self._about[decision] = named
        entity = self._about.get(decision, "")
        outcome = {str(fields.get(key, "")) for key in ("result", "verification", "gate")}
        mark = "warning" if outcome & _BAD or entry.what in ("kept", "torn", "unwell") else ""
        mark = mark or ("ok" if outcome & _GOOD else "")
        return JournalRow(
            entry.n, entry.time, self._clock(entry.time), entry.what, mark, decision, entity, _text(entry.what, fields),
            entry.hash,
        )  # fmt: skip


def _text(what: str, fields: Mapping[str, Any]) -> str:
    parts = []
    if isinstance(action := fields.get("action"), dict):
        parts.append(action_text(action))
    if what == "decided":
        if because := because_text(fields.get("because")):
            parts.append(f"because {because}")
        if cause := fields.get("first_cause"):
            parts.append(f"first cause: {cause}")
        if text := fields.get("text"):
            parts.append(str(text))
    else:
        first = {key: fields[key] for key in _FIRST if key in fields}
        parts.append(rest_text({**first, **fields}, leave_out=("entity",)))
    return "; ".join(filter(None, parts))
