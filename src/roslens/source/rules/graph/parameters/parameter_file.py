"""Rule ``graph.parameter_file``: a file of parameters that has none for the node it is given to."""

from __future__ import annotations

from collections.abc import Iterator, Set

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import listed
from roslens.source.rules.graph.likeness import distance, nearest_name
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Ignored, Surroundings

RULE = graph_rule(
    "graph.parameter_file",
    "Parameter file for another node",
    "A parameter file is passed to a node, and none of its keys is the name of this node or a pattern that matches "
    "it. The name in the file must be the fully resolved name: `/ns/node`, or `node` in the root namespace, or `/**`. "
    "It is a note if the file is for other nodes that run, or for three nodes and more: one file for many nodes is "
    "common.",
    Consequence.WRONG,
    Certainty.PROVEN,
    ("ros", "graph", "parameters", "launch"),
    "The whole file is ignored silently; the node runs with its defaults, which `ros2 param` shows as its parameters.",
)

OF_A_SYSTEM = 3
"""So many nodes have parameters in a file that is one for a whole system."""


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each file that is ignored by the node it is given to."""
    conditions = {node.name: node.conditions for node in configuration.nodes}
    for one in surroundings.ignored:
        yield _told(one, conditions.get(one.node, ()), conditions.keys())


def _misspelt(one: Ignored, running: Set[str]) -> str:
    """Return the key that is the node's name with a typing mistake; empty where there is none.

    The name of another node that runs is none; in a file for a whole system, nor is one with two different signs:
    `map_saver` is no `map_server`.
    """
    near = nearest_name(one.node, [key for key in one.keys if key not in running])
    is_of_a_system = len(set(one.keys)) >= OF_A_SYSTEM
    return "" if near and is_of_a_system and distance(one.node, near) > 1 else near


def _told(one: Ignored, conditions: tuple[str, ...], running: Set[str]) -> Finding:
    of_others = not running.isdisjoint(one.keys)
    last = one.node.rpartition("/")[2]
    same = [key for key in one.keys if key.rpartition("/")[2] == last]
    near = same[0] if same else _misspelt(one, running)
    shared = not near and (of_others or len(set(one.keys)) >= OF_A_SYSTEM)
    certainty, doubt = weighed(Certainty.HEURISTIC if shared else RULE.certainty, (one.proof, one.given), conditions)
    hint = f" `{near}` is nearly it." if near else ""
    keys = listed([f"`{key}`" for key in one.keys])
    own = "" if one.also else f"`{one.node}` or to "
    whose = "other nodes that run, " if shared and of_others else "other nodes, " if shared else ""
    perhaps = ", if it is meant" if shared else ""
    who = listed([one.node, *one.also])
    message = (
        f"{one.given.place} gives {one.proof.path} to {who}, but it is keyed to {whose}{keys}: "
        f"all of it is ignored.{hint} Key it to {own}`/**`{perhaps}."
    )
    entity, also = f"node:{one.node}", tuple(f"node:{name}" for name in one.also)
    return occurrence(
        RULE, message, one.proof, entity=entity, certainty=certainty, context=one.proof.path, also=also, doubt=doubt
    )
