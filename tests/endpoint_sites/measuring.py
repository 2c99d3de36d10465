"""Call sites that make endpoints, as tables have them and as the evaluation of source tells them.

A row of a table is a call site: file and line, what it makes, its type, its name as written below what its node handle
puts in front, with ``*`` for what is unknown; and what decides the unknown part: a parameter, an argument, the port of
a behaviour tree, the ``caller`` of a helper, or a ``message`` that arrives. ``|`` stands between what is right.
"""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

import msgspec

from roslens.source.extract.cpp_program import program_of_cpp
from roslens.source.extract.node_facts import EndpointFact, Sure
from roslens.source.extract.program import Program
from roslens.source.extract.python_program import program_of_python
from roslens.source.extract.text import Hole, Text
from roslens.source.extract.workspace_index import Index
from roslens.source.extract.workspace_units import facts_of_workspace
from roslens.source.syntax.macros import load_macros

TABLES = Path(__file__).parents[1] / "fixtures" / "extract"
REPOSITORIES = ("navigation2", "turtlebot3", "demos", "examples", "image_pipeline", "navigation", "ros_tutorials")
LEFT_OUT = frozenset({"test", "tests", "nav2_system_tests", ".git"})
CALLER = "caller"
MESSAGE = "message"
_CPP = frozenset({".cpp", ".hpp", ".h", ".cc", ".hh", ".cxx", ".hxx"})
_NEAR = 2
"""Lines that a statement may lie away from the line in the table, as calls go over several lines."""

Row = Mapping[str, str]
Found = dict[tuple[str, str], list[tuple[int, EndpointFact]]]


class Measured(msgspec.Struct):
    """What was told of the rows of one table.

    Attributes:
        counts: of rows by role (and ``all``) and by what was told: ``sites``, ``found``, ``typed``, ``named``.
        missed: rows whose type or name was not told.
        wrong: what was told for certain and is not so.
    """

    counts: Counter[tuple[str, str]]
    missed: list[str]
    wrong: list[str]

    def share(self, what: str, role: str = "all") -> float:
        """Return the share of rows of a role."""
        return self.counts[role, what] / max(self.counts[role, "sites"], 1)


def rows_of(repository: str) -> list[Row]:
    """Return the table of a repository."""
    with (TABLES / repository / "endpoints.csv").open() as file:
        return list(csv.DictReader(file))


def programs_below(root: Path) -> Iterator[tuple[str, Program]]:
    """Yield the programs of a checkout, tests left out."""
    macros = load_macros()
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if LEFT_OUT & set(name.split("/")) or not path.is_file():
            continue
        if path.suffix in _CPP:
            yield name, program_of_cpp(path.read_bytes(), macros)
        elif path.suffix == ".py" or (not path.suffix and path.read_bytes()[:40].startswith(b"#!/usr/bin/env python")):
            yield name, program_of_python(path.read_bytes())


def found_below(root: Path) -> Found:
    """Return the endpoints that a checkout makes by file and role, with the lines of their evidence."""
    found: Found = {}
    for facts in facts_of_workspace(Index(dict(programs_below(root)))):
        for one in facts.endpoints:
            for place in (one.evidence, *one.through):
                found.setdefault((place.path, one.role.value), []).append((place.line, one))
    return found


def measured(rows: list[Row], found: Found) -> Measured:
    """Return what was told of the rows of a table."""
    result = Measured(Counter(), [], [])
    for row in rows:
        near = _nearest(row, found)
        typed = [one for one in near if is_typed(row, one.type)]
        named = [one for one in near if is_named(row, one.name)]
        for what, given in (("sites", True), ("found", near), ("typed", typed), ("named", named)):
            result.counts[row["role"], what] += bool(given)
            result.counts["all", what] += bool(given)
        place = f"{row['path']}:{row['line']}"
        if not typed or not named:
            told = [f"{one.name} {one.type}" for one in near][:3]
            result.missed.append(f"{place} {row['name']} {row['type']} {row['decides']}: {told}")
        result.wrong += [f"{place} is not {one.name} {one.type} for sure" for one in near if _is_wrong(row, one)]
    result.counts["all", "message"] = sum(row["decides"] == MESSAGE for row in rows)
    return result


def _nearest(row: Row, found: Found) -> list[EndpointFact]:
    near = found.get((row["path"], row["role"]), [])
    least = min((abs(line - int(row["line"])) for line, _ in near), default=_NEAR + 1)
    return [one for line, one in near if abs(line - int(row["line"])) == least <= _NEAR]


def _is_wrong(row: Row, one: EndpointFact) -> bool:
    """Whether something is told for certain that is not as the table says, however much else is missed."""
    if one.evidence.sure is not Sure.CERTAIN:
        return False
    name = CALLER not in row["decides"].split("|") and not is_named(row, one.name)
    return name or (one.type.known is not None and not is_typed(row, one.type))


def is_typed(row: Row, kind: Text) -> bool:
    """Whether a type is the one in the table."""
    return bool(kind.known) if row["type"] == "*" else kind.known in row["type"].split("|")


def is_named(row: Row, name: Text) -> bool:
    """Whether a name is the one in the table, or tells what decides it."""
    name = relative(name)
    decides = row["decides"].split("|")
    if not row["decides"]:
        return name.known in row["name"].split("|")
    if CALLER in decides and (name.usual is not None or any(hole.parameter for hole in name.holes)):
        return True
    told = [text for hole in name.holes for text in (hole.parameter, hole.reason)]
    return any(one in text for one in decides for text in told)


def relative(name: Text) -> Text:
    """Return a name without the namespace of its node in front: code that resolves names itself says no more by it."""
    if len(name.parts) != 2:
        return name
    first, rest = name.parts
    own = isinstance(first, Hole) and first.reason == "namespace of the node" and isinstance(rest, str)
    return Text.of(rest.removeprefix("/")) if own and isinstance(rest, str) else name
