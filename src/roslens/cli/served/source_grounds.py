"""Where its source has what runs, so that a node stands at the same place in the pictures of both."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import TYPE_CHECKING

from roslens.dashboard.computation.picture import Grounds, grounds_of

if TYPE_CHECKING:
    from roslens.dashboard.site import Site

_LEAST_SHARE = 0.5
"""Share of the nodes that run which a configuration must have for its picture to be theirs."""


def source_grounds(site: Site) -> Callable[[Collection[str]], Grounds | None]:
    """Return what gives the grounds of the configuration that most of the nodes are of; None where no one fits."""
    made: dict[str, Grounds] = {}
    asked: list[tuple[tuple[int, tuple[str, ...]], Grounds | None]] = []

    def grounds(nodes: Collection[str]) -> Grounds | None:
        systems = site.book.systems
        key = (len(systems), tuple(nodes))
        if asked and asked[0][0] == key:
            return asked[0][1]
        there = set(nodes)
        best, most = "", 0
        for slug, system in systems.items():
            alike = len(there & {f"node:{node.name}" for node in system.nodes})
            if alike > most:
                best, most = slug, alike
        found = None
        if most and most >= _LEAST_SHARE * len(there):
            if best not in made:
                made[best] = grounds_of(systems[best])
            found = made[best]
        asked[:] = [(key, found)]
        return found

    return grounds
