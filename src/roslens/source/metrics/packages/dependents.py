"""Number of dependents (#Dep)."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.metrics.packages.dependency_graph import DependencyGraph

QUANTITY = Quantity(
    key="dependents",
    title="Dependents",
    unit="packages",
    kinds=(EntityKind.PACKAGE,),
    text="How many other packages of the workspace depend on a package directly.",
    better=Better.NEITHER,
    formula="number of other packages of the workspace in whose `dependencies` the package is",
    source="Santos et al., A Framework for Quality Assessment of ROS Repositories, IROS 2016 (#Dep)",
    limits="Only what is analysed together is seen. Where two packages have one name, a dependency counts for both.",
)


def of_graph(graph: DependencyGraph) -> dict[str, float]:
    """Return the number of dependents of each package by id."""
    numbers: dict[str, float] = dict.fromkeys(graph.below, 0)
    for package, targets in graph.below.items():
        for target in targets:
            if target != package:
                numbers[target] += 1
    return numbers
