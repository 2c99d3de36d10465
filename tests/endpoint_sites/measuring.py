"""Call sites that make endpoints, as tables have them and as the command shows them.

A row of a table is a call site: file and line, what it makes, its type, its name as written below what its node handle
puts in front, with ``*`` for what is unknown; and what decides the unknown part: a parameter, an argument, the port of
a behaviour tree, the ``caller`` of a helper, or a ``message`` that arrives. ``|`` stands between what is right.
"""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec

TABLES = Path(__file__).parents[1] / "fixtures" / "extract"
REPOSITORIES = ("navigation2", "turtlebot3", "demos", "examples", "image_pipeline", "navigation", "ros_tutorials")
CALLER = "caller"
MESSAGE = "message"
_NEAR = 2
"""Lines that a statement may lie away from the line in the table, as calls go over several lines."""

_NAMESPACE = "{namespace of the node}/"
Row = Mapping[str, str]


class Seen(msgspec.Struct, frozen=True):
    """An endpoint as the command shows it: its name as the code gives it, with ``{reason}`` for what is unknown.

    Attributes:
        given: its name.
        type: empty where unknown.
        sure: how sure it is.
        conditional: whether it is made under a condition, so that it is one of several.
    """

    given: str
    type: str = ""
    sure: str = "certain"
    conditional: bool = False

    def __str__(self) -> str:
        """Return name and type."""
        return f"{self.given} {self.type}"


Found = dict[tuple[str, str], list[tuple[int, Seen]]]
"""By file and role, with lines."""


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


def found_by_command(answer: Mapping[str, Any]) -> Found:
    """Return the endpoints that the command shows by file and role, with the lines where they are made."""
    found: Found = {}
    for configuration in answer.get("configurations", ()):
        for node in configuration["nodes"]:
            for one in node.get("endpoints", ()):
                end, proof = one["endpoint"], one["proof"]
                name, sure = one.get("given", end["name"]), proof.get("sure", "certain")
                seen = Seen(name, end.get("type", ""), sure, bool(one.get("conditions")))
                for place in (proof, *one.get("through", ())):
                    found.setdefault((place["path"], end["role"]), []).append((place["line"], seen))
    return found


def measured(rows: list[Row], found: Found) -> Measured:
    """Return what was told of the rows of a table."""
    result = Measured(Counter(), [], [])
    for row in rows:
        near = _nearest(row, found)
        typed = [one for one in near if is_typed(row, one.type)]
        named = [one for one in near if is_named(row, one.given)]
        for what, given in (("sites", True), ("found", near), ("typed", typed), ("named", named)):
            result.counts[row["role"], what] += bool(given)
            result.counts["all", what] += bool(given)
        place = f"{row['path']}:{row['line']}"
        if not typed or not named:
            told = [str(one) for one in near][:3]
            result.missed.append(f"{place} {row['name']} {row['type']} {row['decides']}: {told}")
        wrong = [f"{place} is not {one} for sure" for one in near if _is_wrong(row, one)]
        # One call may make several endpoints: an image and what the camera says of it.
        right = any(is_named(row, one.given) and is_typed(row, one.type) for one in near)
        result.wrong += [] if right else dict.fromkeys(wrong)
    result.counts["all", "message"] = sum(row["decides"] == MESSAGE for row in rows)
    return result


def _nearest(row: Row, found: Found) -> list[Seen]:
    near = found.get((row["path"], row["role"]), [])
    least = min((abs(line - int(row["line"])) for line, _ in near), default=_NEAR + 1)
    return [one for line, one in near if abs(line - int(row["line"])) == least <= _NEAR]


def _is_wrong(row: Row, one: Seen) -> bool:
    """Whether something is told for certain that is not as the table says, however much else is missed."""
    if one.sure != "certain" or (one.conditional and row["decides"] == MESSAGE):
        return False
    name = CALLER not in row["decides"].split("|") and not is_named(row, one.given)
    return name or (bool(one.type) and not is_typed(row, one.type))


def is_typed(row: Row, kind: str) -> bool:
    """Whether a type is the one in the table."""
    return bool(kind) if row["type"] == "*" else kind in row["type"].split("|")


def is_named(row: Row, given: str) -> bool:
    """Whether a name is the one in the table, or tells what decides it."""
    given = relative(given)
    decides = row["decides"].split("|")
    if not row["decides"]:
        return given in row["name"].split("|")
    if CALLER in decides and ("{" not in given or "{parameter" in given):
        return True
    whole, outer = holes(given)
    return any(one in whole or one in outer for one in decides)


def holes(given: str) -> tuple[str, str]:
    """Return what is told of unknown parts of a name, and the same with ``*`` for what is unknown of these.

    ``{parameter {each of sources}.topic}`` is ``parameter each of sources.topic``, and ``parameter *.topic``.
    """
    depth, whole, outer = 0, [], []
    for sign in given:
        depth -= sign == "}"
        if sign in "{}":
            outer += ["*"] if sign == "}" and depth == 1 else []
        else:
            whole += [sign] if depth else []
            outer += [sign] if depth == 1 else []
        depth += sign == "{"
    return "".join(whole), "".join(outer)


def relative(given: str) -> str:
    """Return a name without the namespace of its node in front: code that resolves names itself says no more by it."""
    return given.removeprefix(_NAMESPACE)
