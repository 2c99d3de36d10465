"""Tier of a package."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.metrics.packages.dependency_graph import DependencyGraph

QUANTITY = Quantity(
    key="tier",
    title="Tier",
    unit="levels",
    kinds=(EntityKind.PACKAGE,),
    text="The level of a package above its dependencies in the workspace; 0 has none there.",
    better=Better.NEITHER,
    formula="length of the longest chain of dependencies below the package inside the workspace; packages of one "
    "cycle count as one package and share their tier",
    source="Lakos, Large-Scale C++ Software Design, 1996 (levelisation; his level is one more)",
    limits="Packages outside the workspace do not count.",
)


def of_graph(graph: DependencyGraph) -> dict[str, float]:
    """Return the tier of each package by id."""
    tiers: dict[str, float] = {}
    for component in graph.components:
        inside = set(component)
        below = [tiers[target] for package in component for target in graph.below[package] if target not in inside]
        tiers.update(dict.fromkeys(component, 1 + max(below) if below else 0))
    return tiers
