"""What the evaluation of a unit came to, and on which files that depends."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from roslens.source.extract.facts.node_facts import NodeFacts
    from roslens.source.extract.symbols.reached_functions import Reached

UnitName = tuple[str, ...]
"""Which unit is meant: its kind, its file and place, and what it is given."""


class EvaluatedUnit(NamedTuple):
    """A unit that was evaluated.

    Attributes:
        facts: of the nodes that it makes.
        reached: the functions that were followed.
        files: those that something was learned from, sorted.
    """

    facts: tuple[NodeFacts, ...]
    reached: Reached
    files: tuple[str, ...]


class KnownUnits(Protocol):
    """Units that were evaluated before, in this process or in an earlier one."""

    def get(self, name: UnitName) -> EvaluatedUnit | None:
        """Return a unit; None where it has to be evaluated."""

    def add(self, name: UnitName, unit: EvaluatedUnit) -> None:
        """Know a unit from now on."""
