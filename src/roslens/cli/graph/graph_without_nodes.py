"""Why there are no nodes: what was not understood, what was not found, and what to check instead."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource

_MOST = 10


def reasons(source: GraphSource, launch: str | None) -> Iterator[str]:
    """Yield lines with the reasons why a workspace or launch file has no nodes.

    Args:
        source: that was read.
        launch: the launch file that was asked for; None of packages.
    """
    missed = [f"{one.evidence.path}:{one.evidence.line}: {one.text}: {one.reason}" for one in source.facts.unresolved]
    yield from _some(missed, "places that were not understood")
    if launch:
        return
    lost = list(_not_found(source))
    yield from _some(lost, "programs that are not installed where they are looked for")
    starting = source.first_launch_files()
    if not missed and not lost and source.facts.packages:
        yield "no program that its packages build makes a node"
    if starting:
        more = f", or one of {len(starting) - 1} more" if len(starting) > 1 else ""
        yield f"launch files start nodes of other packages: try --launch {starting[0]}{more}"


def _some(lines: list[str], what: str) -> Iterator[str]:
    yield from lines[:_MOST]
    if len(lines) > _MOST:
        yield f"and {len(lines) - _MOST} more {what}"


def _not_found(source: GraphSource) -> Iterator[str]:
    """Yield the programs of Python packages that ``ros2 run`` and launch files do not find (ament_index, ros2pkg)."""
    for package in source.facts.packages:
        for target in source.facts.targets(package.name):
            where = target.evidence
            if target.elsewhere:
                advice = "ros2 run and launch files look there; set install_scripts in setup.cfg"
                yield f"{where.path}:{where.line}: {target.name} is {where.how}: {advice}"
