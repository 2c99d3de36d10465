"""What HAROS plug-ins reported, kept for the second pass, in which each sees what all reported.

Notes live in the folder for temporary files of the run, one file of JSON lines per plug-in, because each
plug-in runs in a process of its own and may be started again after a crash.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path

import msgspec

from roslens.plugins.haros.declared import Declared, HarosMetric, HarosRule
from roslens.plugins.haros.scopes import Location, Package, Project, SourceFile


class Note(msgspec.Struct, frozen=True, omit_defaults=True):
    """One violation (with ``details``) or one measurement (with ``value``) as it was reported."""

    scope: str
    what: str
    line: int | None = None
    function: str | None = None
    class_: str | None = None
    details: str = ""
    value: float | None = None


class Notebook(msgspec.Struct, frozen=True):
    """The first line of a file of notes: what the ids in it mean."""

    rules: dict[str, HarosRule]
    metrics: dict[str, HarosMetric]


class Violation:
    """An occurrence of a rule as the second pass sees it."""

    def __init__(self, rule: HarosRule, location: Location, details: str) -> None:
        """Take the rule, the place and the message."""
        self.rule = rule
        self.location = location
        self.details = details
        self.affected = [location.smallest_scope]

    @property
    def scope(self) -> SourceFile | Package:
        """The file or package concerned."""
        return self.location.smallest_scope


class Measurement:
    """A value of a metric as the second pass sees it."""

    def __init__(self, metric: HarosMetric, location: Location, value: float) -> None:
        """Take the metric, the place and the value."""
        self.metric = metric
        self.location = location
        self.value = value

    @property
    def scope(self) -> SourceFile | Package:
        """The file or package concerned."""
        return self.location.smallest_scope


def write_notes(scratch: str, declared: Declared, notes: Iterable[Note]) -> None:
    """Add notes to the file of a plug-in."""
    path = Path(scratch, "haros", f"{declared.name}.jsonl")
    encoder = msgspec.json.Encoder()
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(encoder.encode(Notebook(declared.rules, declared.metrics)) + b"\n")
    with path.open("ab") as stream:
        stream.writelines(encoder.encode(note) + b"\n" for note in notes)


def read_notes(scratch: str, project: Project) -> dict[str, tuple[list[Violation], list[Measurement]]]:
    """Return what all plug-ins reported, by id of the file or package; plug-ins in the order of their names."""
    scopes: dict[str, SourceFile | Package] = {}
    for package in project.packages:
        scopes[package.id] = package
        scopes.update((file.id, file) for file in package.source_files)
    found: dict[str, tuple[list[Violation], list[Measurement]]] = defaultdict(lambda: ([], []))
    for path in sorted(Path(scratch, "haros").glob("*.jsonl")):
        with path.open("rb") as stream:
            book = msgspec.json.decode(stream.readline(), type=Notebook)
            for line in stream:
                note = msgspec.json.decode(line, type=Note)
                location = _location(scopes[note.scope], note)
                if note.value is not None:
                    found[note.scope][1].append(Measurement(book.metrics[note.what], location, note.value))
                else:
                    found[note.scope][0].append(Violation(book.rules[note.what], location, note.details))
    return found


def _location(scope: SourceFile | Package, note: Note) -> Location:
    location = scope.location
    location.line, location.function, location.class_ = note.line, note.function, note.class_
    return location
