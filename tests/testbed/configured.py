"""Configurations made by hand, a line for each end: what rules of the computation graph are tested with."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from roslens.model.configuration import (
    Clause,
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    ConfiguredParameter,
    ConfiguredRemap,
    ConfiguredTimer,
    Origin,
    Proof,
)
from roslens.model.graph import Endpoint, Role
from roslens.model.qos import Qos

ROLES = {
    "pub": Role.PUBLISHER,
    "sub": Role.SUBSCRIPTION,
    "serve": Role.SERVICE_SERVER,
    "call": Role.SERVICE_CLIENT,
    "act": Role.ACTION_SERVER,
    "ask": Role.ACTION_CLIENT,
}
RELIABLE = Qos("reliable", "volatile", "keep_last", 10)
LATCHED = Qos("reliable", "transient_local", "keep_last", 1)
SENSOR = Qos("best_effort", "volatile", "keep_last", 5)


def end(
    role: str, name: str, type: str = "sensor_msgs/msg/LaserScan", line: int = 1, *,  # noqa: A002
    qos: Qos | None = None, sure: str = "certain", path: str = "", origin: Origin = Origin.CODE, hash: str = "",  # noqa: A002
    how: str = "", **more: Any,
) -> ConfiguredEndpoint:  # fmt: skip
    """Return an endpoint; its node is filled in by :func:`node`, and so is the file where it has none."""
    proof = Proof(path, line, how=how, sure=sure, origin=origin)
    more = {"clauses": clauses(more.get("conditions", ())), "given": name, **more}
    return ConfiguredEndpoint(Endpoint("", ROLES[role], name, type, hash, qos), proof, **more)


def node(name: str, *ends: ConfiguredEndpoint, line: int = 1, known: bool = True, **more: Any) -> ConfiguredNode:
    """Return a node that a launch file starts, whose code is in ``src/<name>.cpp``."""
    import msgspec

    path = f"src{name}.cpp"
    filled = []
    for one in ends:
        proof = one.proof if one.proof.path else msgspec.structs.replace(one.proof, path=path)
        endpoint = msgspec.structs.replace(one.endpoint, node=name)
        filled.append(msgspec.structs.replace(one, endpoint=endpoint, proof=proof))
    usual = {
        "proof": launched(line),
        "package": "robot",
        "executable": name.strip("/"),
        "defined": Proof(path, 1) if known else None,
        "clauses": clauses(more.get("conditions", ())),
    }
    return ConfiguredNode(name, endpoints=tuple(filled), **{**usual, **more})


def clauses(conditions: Iterable[str]) -> tuple[Clause, ...]:
    """Return conditions as what holds, and what does not: `not x`."""
    return tuple(Clause(one.removeprefix("not "), not one.startswith("not ")) for one in conditions)


def launched(line: int = 1, path: str = "launch/robot.launch.xml", sure: str = "certain") -> Proof:
    """Return a place in a launch file."""
    return Proof(path, line, sure=sure, origin=Origin.LAUNCH)


def parameter(name: str, **more: Any) -> ConfiguredParameter:
    """Return a parameter."""
    return ConfiguredParameter(name, **more)


def remap(source: str, target: str, line: int = 1, *, used: bool = False, uncertain: bool = False) -> ConfiguredRemap:
    """Return a remapping of a launch file."""
    return ConfiguredRemap(source, target, launched(line), used, uncertain)


def timer(period_s: float | None, callback: str = "", group: str = "") -> ConfiguredTimer:
    """Return a timer."""
    return ConfiguredTimer(period_s, Proof("src/timer.cpp", 1), callback, group)


def configuration(*nodes: ConfiguredNode, generation: str = "ros2", **more: Any) -> Configuration:
    """Return what runs together."""
    return Configuration("robot.launch.xml", generation, tuple(sorted(nodes, key=lambda one: one.name)), **more)
