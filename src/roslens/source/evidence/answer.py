"""The three answers to a requirement."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.model.requirement import Item, Met
from roslens.model.source import Location
from roslens.source.evidence.requirements import BY_NUMBER

MOST_PLACES = 5


def met(number: str, shown: str, *where: Location | None) -> Item:
    """Return that a requirement is met, and what shows it."""
    return _item(number, Met.MET, shown, where)


def not_met(number: str, shown: str, *where: Location | None) -> Item:
    """Return that a requirement is not met, and what shows it."""
    return _item(number, Met.NOT_MET, shown, where)


def not_known(number: str, shown: str, *where: Location | None) -> Item:
    """Return that the source does not show whether a requirement is met, and why."""
    return _item(number, Met.NOT_KNOWN, shown, where)


def _item(number: str, state: Met, shown: str, where: Iterable[Location | None]) -> Item:
    places = tuple(one for one in where if one is not None)[:MOST_PLACES]
    return Item(BY_NUMBER[number], state, shown, places)
