"""Number of dependencies."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity
from roslens.source.metrics.packages.dependency_graph import DependencyGraph

QUANTITY = Quantity(
    key="dependencies",
    title="Dependencies",
    unit="packages",
    kinds=(EntityKind.PACKAGE,),
    text="How many other packages and system libraries a package declares as dependencies.",
    formula="number of distinct names in the active dependency tags of the manifest (build, buildtool, export, exec, "
    "run, test and depend), members of a group it depends on included",
    source="REP-127, REP-140, REP-149",
    limits="As declared in the manifest, in the workspace or not; doc, conflict and replace do not count. Undeclared "
    "dependencies of the code do not count either.",
)


def of_graph(graph: DependencyGraph) -> dict[str, float]:
    """Return the number of dependencies of each package by id."""
    return {package: len(names) for package, names in graph.declared.items()}
