"""Repositories that nobody had opened when they were measured: the tables in ``tests/fixtures/held_out``.

Each folder is a set: ``about.yaml``, ``calls.csv`` by repository, ``endpoints.csv`` and ``notes.yaml`` as they were
drawn and judged by reading. The warnings and errors of a set are in ``tests/fixtures/graph_findings``.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path
from typing import TypeVar

import msgspec
from graph_findings.judgements import TABLES, Judgement, Sample, read

from accuracy.system import ROOT
from roslens.intake.safe_yaml import load_yaml

SETS = ROOT / "tests" / "fixtures" / "held_out"
RIGHT, OPEN, WRONG = "right", "open", "wrong"
Row = TypeVar("Row")


class About(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """How a set was drawn and measured.

    Attributes:
        title: of its section.
        measured_at: commit of roslens.
        repositories_seed: that the repositories were drawn with; 0 where they were gathered by search.
        endpoints_seed: that endpoints were drawn with.
        endpoints: how many the command shows in all.
        findings_seed: that findings were drawn with.
        notes: how many notes there are in all.
        since: what became of the set after the measurement.
    """

    title: str
    measured_at: str
    repositories_seed: int
    endpoints_seed: int
    endpoints: int
    findings_seed: int
    notes: int
    since: str


class Calls(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Calls of a repository that look as if they made an endpoint, and what the command says of them.

    Attributes:
        repository: ``owner/name``.
        commit: that was measured.
        calls: by text, without lines that declare or define a function of such a name.
        shown: of these.
        named: of these, as unresolved.
        lines: by text, with lines that declare or define such a function.
        lines_shown: of these.
        lines_named: of these, as unresolved.
    """

    repository: str
    commit: str
    calls: int
    shown: int
    named: int
    lines: int
    lines_shown: int
    lines_named: int


class Endpoint(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """An endpoint that was drawn, and whether source says the same.

    Attributes:
        repository: ``owner/name``.
        path: of the file that makes it.
        line: in it.
        role: ``publisher`` …
        name: as shown; ``*`` stands for what the command leaves open.
        type: as shown; empty where it is left open.
        sure: ``certain``, ``likely`` or ``possible``.
        judgement: ``right``, ``open`` (what is shown is right, and the name is not told) or ``wrong``; empty is not
            judged yet.
        why: what there is to say of it.
    """

    repository: str
    path: str
    line: int
    role: str
    name: str
    type: str
    sure: str
    judgement: str = ""
    why: str = ""


class HeldOut(msgspec.Struct, frozen=True):
    """A set: its tables.

    Attributes:
        name: of its folder.
        about: how it was drawn.
        calls: by repository.
        endpoints: that were drawn.
        warnings: warnings and errors that were drawn.
        notes: that were drawn.
    """

    name: str
    about: About
    calls: tuple[Calls, ...]
    endpoints: tuple[Endpoint, ...]
    warnings: Sample
    notes: tuple[Judgement, ...]


def held_out(folder: Path = SETS) -> Iterator[HeldOut]:
    """Yield the sets in order of their folders.

    Raises:
        ValidationError: a table is none.
    """
    for path in sorted(one for one in folder.iterdir() if one.is_dir()):
        yield HeldOut(
            path.name,
            msgspec.convert(load_yaml((path / "about.yaml").read_bytes()), About),
            rows_of(path / "calls.csv", Calls),
            rows_of(path / "endpoints.csv", Endpoint),
            read(TABLES / f"held_out_{path.name}.yaml"),
            tuple(read(path / "notes.yaml").findings),
        )


def rows_of(path: Path, kind: type[Row]) -> tuple[Row, ...]:
    """Return the rows of a table."""
    with path.open(encoding="utf-8", newline="") as file:
        return tuple(msgspec.convert(row, kind, strict=False) for row in csv.DictReader(file))


def write_rows(path: Path, rows: list[Row]) -> None:
    """Write a table of at least one row."""
    every = [msgspec.to_builtins(one) for one in rows]
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, list(every[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(every)
