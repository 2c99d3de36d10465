"""Size of the dependency cycle around a package."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity
from roslens.source.metrics.packages.dependency_graph import DependencyGraph

QUANTITY = Quantity(
    key="cycle",
    title="Dependency cycle",
    unit="packages",
    kinds=(EntityKind.PACKAGE,),
    text="How many packages depend on each other in a cycle with this one; 0, as required, without a cycle.",
    formula="number of packages in the strongly connected component of the package; 0 if it is alone there, 1 if it "
    "depends on itself",
    source="Tarjan, Depth-First Search and Linear Graph Algorithms, SIAM J. Computing 1(2), 1972; REP-149 asks for a "
    "graph without cycles",
    limits="Cycles through packages outside the workspace are not seen. Several cycles that share a package are one.",
)


def of_graph(graph: DependencyGraph) -> dict[str, float]:
    """Return the size of the cycle of each package by id."""
    sizes: dict[str, float] = {}
    for component in graph.components:
        for package in component:
            alone = len(component) == 1 and package not in graph.below[package]
            sizes[package] = 0 if alone else len(component)
    return sizes
