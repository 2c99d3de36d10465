"""The findings that a team accepted or called false: a file of the repository that is reviewed like its source.

Each ``[[accepted]]`` has the finding's ``fingerprint``, the ``state`` (``accepted`` or ``false_positive``) and a
``reason``; ``rule``, ``path``, ``entity`` and ``message`` say what it was when it was accepted. A finding is known by
its fingerprint. Where the file of an entry is gone, it is known in the file that it moved to: the only one with the
same name, by rule, entity and message.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec
import tomli

from roslens.intake.bounded_file import read_bounded
from roslens.intake.file_budget import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.same_finding import said, within_file
from roslens.model.set_aside import Disposition
from roslens.model.source import Location, SourceFile

FILE_NAME = "roslens.accepted.toml"
MOST_BYTES = 20_000_000
"""A larger file is not read."""


class Acceptance(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """An entry of the file.

    ``fingerprint`` and the rest of what it says of the finding are as they were when it was accepted.
    """

    fingerprint: str
    reason: str
    state: Disposition = Disposition.ACCEPTED
    rule: str = ""
    path: str = ""
    entity: str = ""
    message: str = ""


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    accepted: tuple[Acceptance, ...] = ()


def read_acceptances(path: Path) -> tuple[tuple[Acceptance, ...], tuple[Failure, ...]]:
    """Return the entries of the file and what is wrong with it; a file that is not there has none.

    A wrong entry costs none of the others.
    """
    try:
        text = read_bounded(path, MOST_BYTES).decode("utf-8-sig")
        with file_budget(str(path), size=len(text)):
            document = tomli.loads(text)
    except FileNotFoundError:
        return (), ()
    except (OSError, ValueError, RecursionError, OverBudgetError) as error:
        return (), (_failure(path, f"cannot be read: {error}", "TOML with [[accepted]] tables"),)
    entries = document.get("accepted", [])
    failures = [
        _failure(path, f'unknown key "{key}"', "[[accepted]] tables alone") for key in document if key != "accepted"
    ]
    if not isinstance(entries, list):
        return (), (*failures, _failure(path, "`accepted` is not a list of tables", "[[accepted]] tables"))
    found = []
    places = [number for number, line in enumerate(text.splitlines(), 1) if line.strip().startswith("[[")]
    for index, entry in enumerate(entries):
        line = places[index] if index < len(places) else 0
        try:
            found.append(_checked(msgspec.convert(entry, Acceptance)))
        except (msgspec.ValidationError, ValueError) as error:
            failures.append(_failure(path, f"[[accepted]] {index + 1}: {error}", "a fingerprint and a reason", line))
    return tuple(found), tuple(failures)


def _checked(entry: Acceptance) -> Acceptance:
    if not entry.fingerprint.strip() or not entry.reason.strip():
        raise ValueError("no fingerprint" if not entry.fingerprint.strip() else "no reason")
    if entry.state not in (Disposition.ACCEPTED, Disposition.FALSE_POSITIVE):
        raise ValueError(f'state "{entry.state.value}" is neither accepted nor false_positive')
    return entry


def _failure(path: Path, what: str, expected: str, line: int = 0) -> Failure:
    return Failure(
        tool="accepted",
        what=what,
        expected=expected,
        advice="Fix it; findings accepted there count until then",
        location=Location(path.name, line),
    )


class Acceptances:
    """The entries, by the file in which each of them is looked for."""

    def __init__(self, entries: Sequence[Acceptance] = (), files: Collection[str] = ()) -> None:
        """``files`` are the paths of all files of the run."""
        self.entries = tuple(entries)
        self._known = {entry.fingerprint: entry for entry in reversed(self.entries)}
        self._moved: dict[str, list[Acceptance]] = defaultdict(list)
        self._at: dict[str, list[Acceptance]] = defaultdict(list)
        by_name: dict[str, list[str]] = defaultdict(list)
        for file in files if self.entries else ():
            by_name[PurePosixPath(file).name].append(file)
        there = frozenset(files) if self.entries else frozenset()
        for entry in self.entries:
            if not entry.path or entry.path in there:
                self._at[entry.path].append(entry)
                continue
            alike = by_name.get(PurePosixPath(entry.path).name, [])
            # From another root the same file has a longer or a shorter path.
            nearer = [
                file for file in alike if f"/{file}".endswith(f"/{entry.path}") or entry.path.endswith(f"/{file}")
            ]
            if len(found := nearer or alike) == 1:
                self._moved[found[0]].append(entry)
                self._at[found[0]].append(entry)

    def __bool__(self) -> bool:
        """Whether there is any entry."""
        return bool(self.entries)

    def shaping(self, files: Iterable[str]) -> Iterator[tuple[Acceptance, ...]]:
        """Yield what the result of a package with these files depends on: entries that can concern it, if any."""
        if self.entries and (found := tuple(entry for file in sorted({*files, ""}) for entry in self._at[file])):
            yield found

    def of(self, finding: Finding) -> Acceptance | None:
        """Return the entry by which a finding is accepted."""
        if not self.entries:
            return None
        entry = self._known.get(finding.fingerprint) if finding.fingerprint else None
        if entry is not None:
            return entry
        moved = self._moved.get(finding.path, ())
        return next((one for one in moved if _same(one, finding)), None)


def _same(entry: Acceptance, finding: Finding) -> bool:
    """Return whether an entry for a moved file has the same message; numbers and the file's path may differ."""
    if entry.rule != finding.rule or within_file(entry.entity) != within_file(finding.entity):
        return False
    return said(entry.message, entry.path) == said(finding.message, finding.path)


def acceptances_of(entries: Sequence[Acceptance], files: Mapping[str, Sequence[SourceFile]]) -> Acceptances:
    """Return the entries for a run with these files of each package."""
    return Acceptances(entries, frozenset(file.path for held in files.values() for file in held) if entries else ())


def to_toml(entries: Sequence[Acceptance]) -> str:
    """Return the file with these entries, in the order of paths, rules and fingerprints."""
    parts = [_HEAD]
    for entry in sorted(entries, key=lambda one: (one.path, one.rule, one.message, one.fingerprint)):
        values: Mapping[str, str] = {
            "fingerprint": entry.fingerprint,
            "state": entry.state.value,
            "reason": entry.reason,
            "rule": entry.rule,
            "path": entry.path,
            "entity": entry.entity,
            "message": entry.message,
        }
        lines = [f"{key} = {_string(value)}" for key, value in values.items() if value]
        parts.append("\n".join(("[[accepted]]", *lines)))
    return "\n\n".join(parts) + "\n"


_HEAD = """\
# Accepted findings of roslens, each with its reason. `roslens accept` writes this file;
# `roslens accept --undo FINGERPRINT` removes an entry. Review changes to it like source."""


def _string(text: str) -> str:
    # TOML's basic strings are those of JSON, but for the one control character that JSON leaves as it is.
    return msgspec.json.encode(text).decode().replace("\x7f", "\\u007f")
