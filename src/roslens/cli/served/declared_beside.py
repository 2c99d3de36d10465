"""What the source of the pages beside says of an entity that runs, for an answer why it is as it is."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from roslens.compare.why.declared import Declared, Elsewhere, known_names

if TYPE_CHECKING:
    from roslens.dashboard.computation.system import System
    from roslens.dashboard.site import Site


def declared_beside(site: Site, path: str) -> Callable[[str], Declared | None]:
    """Return what gives the configuration that has an entity, of several the one with most nodes; None where none is.

    Args:
        site: the pages beside.
        path: of the workspace, for commands.
    """

    def declared(entity: str) -> Declared | None:
        kind, _, name = entity.partition(":")
        systems = list(site.book.systems.values())
        if not systems:
            return None

        def fit(system: System) -> tuple[bool, int]:
            known = known_names(Declared("", system.configuration))
            return name in known.get(kind, ()), len(system.configuration.nodes)

        best = max(systems, key=fit)
        elsewhere = tuple(
            Elsewhere(f"{one.configuration.title} starts it", one.configuration, _command(path, one))
            for one in systems
            if one is not best and one.configuration.generation == best.configuration.generation
        )
        return Declared(
            best.configuration.title, best.configuration, elsewhere, best.findings, command=_command(path, best)
        )

    return declared


def _command(path: str, system: System) -> str:
    return f"roslens graph {path} --launch {system.configuration.title.partition(' ')[0]}"
