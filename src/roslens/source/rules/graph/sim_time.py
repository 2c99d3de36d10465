"""Rule ``graph.sim_time``: some nodes take their time from a simulator, and some do not."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, Proof
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.source.rules.graph.doubt import exclude_each_other, weighed
from roslens.source.rules.graph.ends import listed
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.told import TOOL, told

RULE = RuleInfo(
    "graph.sim_time",
    "Two clocks in one system",
    "`use_sim_time` is true for some nodes and not for others that run together. Nodes for which it is unknown, and "
    "publishers of static transforms, are left out. Set it for all of them, by one argument.",
    Severity.WARNING,
    ("ros", "graph", "parameters", "launch"),
    "Stamps of the two kinds of node are decades apart: transforms cannot be looked up, messages count as too old.",
    tool=TOOL,
    scope="configuration",
)
_NAME = "use_sim_time"
_TIMELESS = frozenset({"static_transform_publisher"})


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield at most one finding: the setting of ROS 1 is the same for all nodes."""
    if configuration.generation != "ros2":
        return
    simulated: list[tuple[ConfiguredNode, Proof]] = []
    real: list[ConfiguredNode] = []
    for node in configuration.nodes:
        if node.kind in ("process", "test") or node.executable in _TIMELESS:
            continue
        one = next((parameter for parameter in node.parameters if parameter.name == _NAME), None)
        if one is None or (one.value or "").lower() == "false":
            real.append(node)
        elif one.value is not None and one.value.lower() == "true" and one.set_by is not None:
            simulated.append((node, one.set_by))
    real = [
        node for node in real if any(not exclude_each_other(node.conditions, one.conditions) for one, _ in simulated)
    ]
    if simulated and real:
        yield _told(simulated, real)


def _told(simulated: list[tuple[ConfiguredNode, Proof]], real: list[ConfiguredNode]) -> Finding:
    node, proof = min(simulated, key=lambda one: (len(one[0].conditions), one[0].name))
    without = sorted(real, key=lambda one: (len(one.conditions), one.name))
    severity, doubt = weighed(RULE.severity, (proof,), (*node.conditions, *without[0].conditions))
    others = [f"{one.name} ({one.proof.place})" for one in without]
    message = (
        f"use_sim_time is true for {listed([one.name for one, _ in simulated])} ({proof.place}), but not for "
        f"{listed(others)}. Set it for all nodes that run together.{doubt}"
    )
    return told(RULE, message, without[0].proof, entity=f"node:{without[0].name}", severity=severity)
