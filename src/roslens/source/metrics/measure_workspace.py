"""What only all packages together show."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.model.source import Package
from roslens.source.metrics.packages import cycle, dependencies, dependents, tier
from roslens.source.metrics.packages.dependency_graph import dependency_graph


def measure_workspace(packages: Sequence[Package]) -> dict[str, dict[str, float]]:
    """Return dependencies, dependents, tier and cycle of each package, by its id.

    Files outside packages (:data:`~roslens.model.source.OUTSIDE_PACKAGES`) are no package and have none.
    """
    graph = dependency_graph(packages)
    columns = {metric.QUANTITY.key: metric.of_graph(graph) for metric in (dependencies, dependents, tier, cycle)}
    return {package: {key: float(column[package]) for key, column in columns.items()} for package in graph.below}
