"""Rule ``graph.sim_time``: some nodes take their time from a simulator, and some do not."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec

from roslens.model.configuration import Configuration, ConfiguredNode, Proof, Unresolved
from roslens.model.finding import Finding
from roslens.model.graph import Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.graph.brief import is_brief
from roslens.source.rules.graph.doubt import exclude_each_other, weighed
from roslens.source.rules.graph.ends import listed, missing_parts
from roslens.source.rules.graph.occurrence import graph_rule, ids_of, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.sim_time",
    "Two clocks in one system",
    "`use_sim_time` is true for some nodes and not for others that run together and use stamped messages. Nodes for "
    "which it is unknown, publishers of static transforms, bridges to a simulator and programs that exit after "
    "completing their task are not reported. Set it for all nodes, by one argument.",
    Consequence.WRONG,
    Certainty.LIKELY,
    ("ros", "graph", "parameters", "launch"),
    "The time stamps of the two groups of nodes are decades apart: transforms cannot be looked up, messages are "
    "considered too old.",
)
_NAME = "use_sim_time"
_TIMELESS = frozenset(
    {"static_transform_publisher", "parameter_bridge", "bridge_node", "image_bridge", "joy_node", "teleop_node"}
)
_STAMPED = re.compile(
    r"(?:sensor_msgs|nav_msgs|tf2_msgs|vision_msgs|stereo_msgs|map_msgs)/msg/(?!Joy\b)\w+|\w+/msg/\w*Stamped\w*"
)
"""Types of messages that carry a time as a rule."""


class _Real(msgspec.Struct, frozen=True):
    """A node on the time of the computer; ``set_by`` where something says so, else nothing does."""

    node: ConfiguredNode
    set_by: Proof | None = None

    @property
    def proof(self) -> Proof:
        """The place to change: that of the value, or of the start of a node that is given none."""
        return self.set_by or self.node.proof

    @property
    def label(self) -> str:
        """The node and the places, as messages name it."""
        places = [self.node.proof.place]
        if self.set_by is not None and self.set_by.place != places[0]:
            places.append(f"false in {self.set_by.place}")
        return f"{self.node.name} ({', '.join(places)})"


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield at most one finding: the setting of ROS 1 is the same for all nodes."""
    if configuration.generation != "ros2":
        return
    simulated: list[tuple[ConfiguredNode, Proof]] = []
    real: list[_Real] = []
    for node in (one for one in configuration.nodes if not _needs_no_time(one)):
        setting = next((parameter for parameter in node.parameters if parameter.name == _NAME), None)
        set_by = setting.set_by if setting is not None else None
        value = (setting.value or "").lower() if setting is not None else "false"
        if value == "false" and _stamps(node):
            real.append(_Real(node, set_by))
        elif value == "true" and set_by is not None:
            simulated.append((node, set_by))
    real = [one for one in real if _runs_beside(one.node, simulated)]
    if simulated and real:
        yield _told(simulated, real, missing_parts(configuration))


def _runs_beside(node: ConfiguredNode, others: list[tuple[ConfiguredNode, Proof]]) -> bool:
    """Whether a node may run together with one of several others."""
    return any(not exclude_each_other(node.clauses, other.clauses) for other, _ in others)


def _needs_no_time(node: ConfiguredNode) -> bool:
    return node.kind in ("process", "test") or node.executable in _TIMELESS or is_brief(node) or _is_inner(node)


def _is_inner(node: ConfiguredNode) -> bool:
    """Whether a node is made inside of another one, by a listener of transforms: no launch file sets its parameters."""
    return node.name.rpartition("/")[2].startswith("transform_listener_impl_")


def _stamps(node: ConfiguredNode) -> bool:
    """Whether a node is known to send, or to take, messages with a stamp; who gives the time needs none."""
    ends = [one.endpoint for one in node.endpoints if not one.implicit]
    if any(one.role is Role.PUBLISHER and one.name == "/clock" for one in ends):
        return False
    return any(_STAMPED.fullmatch(one.type) for one in ends)


def _told(simulated: list[tuple[ConfiguredNode, Proof]], real: list[_Real], missing: list[Unresolved]) -> Finding:
    node, proof = min(simulated, key=lambda one: (len(one[0].conditions), one[0].name))
    without = sorted(real, key=lambda one: (len(one.node.conditions), one.node.name))
    more = (
        f"what `{shortened(missing[0].text, 60)}` ({missing[0].proof.place}) starts or sets is unknown"
        if missing
        else ""
    )
    certainty, doubt = weighed(RULE.certainty, (proof,), (*node.conditions, *without[0].node.conditions), more=more)
    others = [one.label for one in without]
    message = (
        f"use_sim_time is true for {listed([one.name for one, _ in simulated])} ({proof.place}), but not for "
        f"{listed(others)}. Set it for all nodes that run together."
    )
    first, *also = ids_of([one.node for one in without])
    return occurrence(RULE, message, without[0].proof, entity=first, certainty=certainty, also=tuple(also), doubt=doubt)
