"""Rule ``graph.parameter_elsewhere``: a node that reads the private parameters of another one (ROS 1)."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter, Origin, Proof
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.parameter_elsewhere",
    "Private parameter of another node",
    "Code of a ROS 1 node reads a parameter below the name of another node. It is a warning if the other node reads "
    "it too, as in copied code, and a note otherwise. Read `~name`.",
    Consequence.MAY_BE_WRONG,
    Certainty.HEURISTIC,
    ("ros", "graph", "parameters", "names"),
    "Values set for the node have no effect on it, and values set for the other one affect both.",
)


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each node and each other one whose parameters it reads: the first of them."""
    if configuration.generation != "ros1":
        return
    nodes = {node.name: node for node in configuration.nodes if node.resolved}
    for node in nodes.values():
        read: dict[str, list[tuple[ConfiguredParameter, Proof]]] = {}
        for one in node.parameters:
            owner = one.name.rpartition("/")[0]
            if one.access == "read" and one.proof is not None and owner in nodes and owner != node.name:
                read.setdefault(owner, []).append((one, one.proof))
        for owner, ones in sorted(read.items()):
            # Nodes below a node, as those of a nodelet manager, may mean what they say.
            if not node.name.startswith(f"{owner}/") and ones[0][1].origin is Origin.CODE:
                yield _told(node, nodes[owner], ones)


def _told(node: ConfiguredNode, owner: ConfiguredNode, ones: list[tuple[ConfiguredParameter, Proof]]) -> Finding:
    one, proof = min(ones, key=lambda pair: pair[1])
    own = {other.name for other in owner.parameters if other.access}
    copied = any(parameter.name in own for parameter, _ in ones)
    certainty, doubt = weighed(
        RULE.certainty if copied else Certainty.HEURISTIC, (proof,), (*node.conditions, *one.conditions)
    )
    more = f" and {len(ones) - 1} more" if len(ones) > 1 else ""
    too = ", which reads it too" if copied else ""
    last = one.name.rpartition("/")[2]
    message = (
        f"{node.name} ({proof.place}) reads `{one.name}`{more}, private to {owner.name}{too}. "
        f"Read `~{last}` if it is meant to be its own."
    )
    entity = f"parameter:{node.name}:{one.name}"
    return occurrence(RULE, message, proof, entity=entity, certainty=certainty, context=owner.name, doubt=doubt)
