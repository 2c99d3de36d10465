"""Strongly connected components: things that lead to each other, in a circle or alone."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Generic, TypeVar

Thing = TypeVar("Thing", bound=Hashable)


def strongly_connected(starts: Iterable[Thing], targets: Callable[[Thing], Iterable[Thing]]) -> Iterator[list[Thing]]:
    """Yield the strongly connected components of all that is reached, each after all that it leads to.

    Tarjan, Depth-First Search and Linear Graph Algorithms, SIAM J. Computing 1(2), 1972, with a stack of its own in
    place of recursion, so that a long chain cannot exhaust Python's.

    Args:
        starts: from where to go, in this order.
        targets: what a thing leads to; asked once for each.
    """
    search = _Search(targets)
    for start in starts:
        yield from search.components(start)


class _Search(Generic[Thing]):
    """A search in depth that is under way."""

    def __init__(self, targets: Callable[[Thing], Iterable[Thing]]) -> None:
        self._targets = targets
        self._index: dict[Thing, int] = {}
        self._low: dict[Thing, int] = {}
        self._open: list[Thing] = []
        self._is_open: set[Thing] = set()
        self._path: list[tuple[Thing, Iterator[Thing]]] = []

    def components(self, start: Thing) -> Iterator[list[Thing]]:
        """Yield the components that are complete once all behind ``start`` was seen."""
        if start in self._index:
            return
        self._enter(start)
        while self._path:
            thing, targets = self._path[-1]
            if self._goes_on(thing, targets):
                continue
            self._path.pop()
            if self._path:
                above = self._path[-1][0]
                self._low[above] = min(self._low[above], self._low[thing])
            if self._low[thing] == self._index[thing]:
                yield self._cut(thing)

    def _enter(self, thing: Thing) -> None:
        self._index[thing] = self._low[thing] = len(self._index)
        self._open.append(thing)
        self._is_open.add(thing)
        self._path.append((thing, iter(self._targets(thing))))

    def _goes_on(self, thing: Thing, targets: Iterator[Thing]) -> bool:
        """Enter the next target that was not visited yet; return whether there was one."""
        for target in targets:
            if target not in self._index:
                self._enter(target)
                return True
            if target in self._is_open:
                self._low[thing] = min(self._low[thing], self._index[target])
        return False

    def _cut(self, thing: Thing) -> list[Thing]:
        """Close the component that begins with ``thing``."""
        component = [self._open.pop()]
        while component[-1] != thing:
            component.append(self._open.pop())
        self._is_open.difference_update(component)
        return component
