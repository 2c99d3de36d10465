"""Rule ``graph.controller_type``: a controller whose type is set in another namespace than it is loaded in (ROS 1)."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.controller_type",
    "Controller whose type is set elsewhere",
    "A launch file of ROS 1 spawns a controller whose parameter `type` is not set in the namespace of the spawner, "
    "while a parameter file sets it in another one. Give both the same namespace: the first key of the file, the "
    "attribute `ns` of the spawner or of what loads the file.",
    Consequence.STOPS_START,
    Certainty.LIKELY,
    ("ros", "graph", "parameters", "names", "launch"),
    "«Could not load controller … because the type was not specified»: no controller is started, and the robot does "
    "not move.",
)
_PACKAGE = "controller_manager"
_OPEN = "controller "
"""Begins what is not resolved of a controller, behind which its name stands."""


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each controller that has no type where it is looked for, and one elsewhere."""
    if configuration.generation != "ros1":
        return
    types = {
        one.name: one
        for one in (*configuration.parameters, *(one for node in configuration.nodes for one in node.parameters))
        if one.name.endswith("/type") and one.set_by is not None
    }
    spawners = {node.proof.place: node for node in configuration.nodes if node.package == _PACKAGE and node.resolved}
    for one in configuration.unresolved:
        spawner = spawners.get(one.proof.place)
        if spawner is None or not one.text.startswith(_OPEN):
            continue
        name = one.text.removeprefix(_OPEN)
        space = spawner.name.rpartition("/")[0]
        elsewhere = sorted(key for key in types if key.endswith(f"/{name}/type"))
        if elsewhere and f"{space}/{name}/type" not in types:
            yield _told(spawner, name, types[elsewhere[0]])


def _told(spawner: ConfiguredNode, name: str, held: ConfiguredParameter) -> Finding:
    space = spawner.name.rpartition("/")[0]
    certainty, doubt = weighed(RULE.certainty, (spawner.proof,), spawner.conditions)
    place = held.set_by.place if held.set_by is not None else ""
    message = (
        f"{spawner.name} loads controller '{name}' and reads its type from {space}/{name}/type, which is not set; "
        f"{held.name} is ({place}). Use the same namespace for both."
    )
    return occurrence(
        RULE, message, spawner.proof, entity=f"node:{spawner.name}", certainty=certainty, context=name, doubt=doubt
    )
