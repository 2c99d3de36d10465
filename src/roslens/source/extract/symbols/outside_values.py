"""Constants and defaults of parameters that files define, and which definition another file means."""

from __future__ import annotations

from typing import TypeVar

from roslens.source.extract.ir.program import Expression, Function, Program
from roslens.source.extract.symbols.linkage import Linkage

T = TypeVar("T")
Placed = tuple[str, Expression]
"""A value and the path of its file."""


class OutsideValues:
    """What files define outside of functions; of several definitions of a name that is meant which a file knows."""

    def __init__(self, linkage: Linkage) -> None:
        """Begin with nothing."""
        self._linkage = linkage
        self._constants: dict[str, list[Placed]] = {}
        self._declared: dict[tuple[str, int], list[tuple[str, Function]]] = {}

    def add(self, name: str, path: str, value: Expression) -> None:
        """Add a constant by its whole name."""
        self._constants.setdefault(name, []).append((path, value))

    def add_file(self, path: str, program: Program) -> None:
        """Add the functions that a file declares with defaults of parameters."""
        for one in program.declarations:
            self._declared.setdefault((one.qualified_name, len(one.parameters)), []).append((path, one))

    def first(self, name: str) -> Placed | None:
        """Return the first definition of a constant."""
        found = self._constants.get(name)
        return found[0] if found else None

    def constant(self, name: str, path: str) -> Placed | None:
        """Return the definition of a constant that a file means."""
        found = self._constants.get(name)
        return self._meant(found, path) if found else None

    def declaration(self, function: Function, path: str) -> Function | None:
        """Return how a function of a file is declared elsewhere."""
        found = self._declared.get((function.qualified_name, len(function.parameters)))
        if not found or len(found) == 1 or not path:
            return found[0][1] if found else None
        meant = self._nearest(found, path)
        return None if meant is None else meant[1]

    def _meant(self, found: list[Placed], path: str) -> Placed | None:
        nearest = self._nearest(found, path)
        if nearest is not None:
            return nearest
        known = [one for one in found if self._linkage.may_know(path, one[0])]
        return known[0] if known and all(one[1] == known[0][1] for one in known) else None

    def _nearest(self, found: list[tuple[str, T]], path: str) -> tuple[str, T] | None:
        """Return the definition of the file itself, of what it includes, else of what it is linked with."""
        if found[0][0] == path:
            return found[0]
        ranks = ((self._linkage.near(path, other), place) for place, (other, _) in enumerate(found))
        ranked = [(near, place) for near, place in ranks if near is not None]
        return found[min(ranked)[1]] if ranked else None
