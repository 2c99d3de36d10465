"""Rule ``graph.lifecycle_manager``: a node that a lifecycle manager waits for, and that nothing starts."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.likeness import nearest_name
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

_PACKAGE = "nav2_lifecycle_manager"
_NAMES = "node_names"

RULE = graph_rule(
    "graph.lifecycle_manager",
    "Managed node that nothing starts",
    "`node_names` of a lifecycle manager of Nav2 has a node that neither the launch file nor what it includes starts, "
    "while others of the list are started. Write the name of the node as it is started; names are relative to the "
    "namespace of the manager. Nothing is reported where a part of the launch is not known.",
    Consequence.STOPS_START,
    Certainty.LIKELY,
    ("ros", "graph", "lifecycle", "launch"),
    "The manager waits for the service of each node in turn: bring-up stops at the one that is missing, and all nodes "
    "behind it stay unconfigured.",
)


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name in the list of a manager that no node has."""
    nodes = configuration.nodes
    # What is not known may start any node.
    if not all(node.resolved for node in nodes) or any(one.opens for one in configuration.unresolved):
        return
    names = {node.name for node in nodes}
    for manager in nodes:
        if manager.package != _PACKAGE:
            continue
        for one in manager.parameters:
            if one.name == _NAMES and one.set_by is not None and one.value is not None:
                yield from _lacking(manager, one, names)


def _lacking(manager: ConfiguredNode, one: ConfiguredParameter, names: set[str]) -> Iterator[Finding]:
    space = manager.name.rpartition("/")[0]
    text = (one.value or "").strip()
    if not (text.startswith("[") and text.endswith("]")) or "*" in text or "{" in text:
        return
    listed = [part.strip().strip("'\"") for part in text[1:-1].split(",") if part.strip()]
    resolved = {name: name if name.startswith("/") else f"{space}/{name}" for name in listed}
    if not any(full in names for full in resolved.values()):
        # All of them are started elsewhere.
        return
    for name, full in resolved.items():
        if full not in names:
            near = nearest_name(full, sorted(names - {manager.name}))
            meant = f" Did you mean {near}?" if near else ""
            certainty, doubt = weighed(RULE.certainty, (one.set_by, manager.proof), manager.conditions)
            message = (
                f"{manager.name} manages '{name}', and nothing starts a node {full}: bring-up waits for it.{meant}"
            )
            proof = one.set_by or manager.proof
            yield occurrence(
                RULE, message, proof, entity=f"node:{manager.name}", certainty=certainty, context=name, doubt=doubt
            )
