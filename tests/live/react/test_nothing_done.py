"""The gate of all reactions: what befalls the line, an observer or the monitor itself leads to no action at all.

The reactions are as rash as can be: they are about everything that is bad or gone, and wait for nothing.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from live.time_line import Played, read

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.react.reactor import Reactor
from roslens.live.window.signals import BY_KEY
from roslens.model.acting.reaction import Decision, Outcome, Result

RASH = """
kind: reference
name: rash
reactions:
- {id: node, settled: 0 s, cool_down: 0 s, when: {node: "**", is: bad, match: each}, do: [{restart: "{entity}"}]}
- {id: being, settled: 0 s, cool_down: 0 s, when: {node: "**", is: [gone, crashed, stopped, hung], match: each}, do: [{restart: "{entity}"}]}
- {id: topic, settled: 0 s, cool_down: 0 s, when: {topic: "**", is: bad, match: each, effects: true}, do: [{notify: "{entity}"}]}
- {id: wire, settled: 0 s, cool_down: 0 s, when: {connection: "**", is: bad, match: each, effects: true}, do: [{notify: "{entity}"}]}
- {id: host, settled: 0 s, cool_down: 0 s, when: {host: "**", is: bad, match: each, effects: true}, do: [{notify: "{entity}"}]}
- {id: lost, settled: 0 s, cool_down: 0 s, when: {host: "**", is: gone, match: each}, do: [{notify: "{entity}"}]}
- {id: not, settled: 0 s, cool_down: 0 s, when: {not: {topic: /scan, is: ok}}, do: [{notify: a}]}
"""  # noqa: E501
REACTIONS = load_reference([GivenText("rash.yaml", RASH.encode())], BY_KEY).reactions
NODES = {"/lidar": "robot", "/imu": "robot", "/drive": "base", "/arm": "arm"}
PUBLISH = {"/lidar": ["/scan"], "/imu": ["/imu"], "/drive": ["/odom"], "/arm": ["/joints"]}
AGENTS = {"/scan": "robot", "/imu": "robot", "/odom": "base", "/joints": "arm"}
UNTIL = 36


def decided(line: dict[str, Any]) -> list[Decision]:
    reactor = Reactor(REACTIONS, start=0.0)
    found = []
    for step in Played(line).steps:
        decisions = reactor.look(step, step.time)
        for one in decisions:
            reactor.reported(one.id, Outcome(Result.DONE))
        found += decisions
    return found


def robot(senders: dict[str, dict[str, Any]], until: float = UNTIL, **others: Any) -> dict[str, Any]:
    """Three hosts with an agent each, an observer of ROS, and sentences about all that they do."""
    named = {"robot/agent": {}, "arm/agent": {}, "base/agent": {}, "base/ros2": {"graph": True}}
    expect = [{"id": f"rate{t}", "name": t, "quantity": "rate", "range": "8..12", "severity": "error"} for t in AGENTS]
    expect += [{"id": f"gap{t}", "name": t, "quantity": "largest_gap", "range": "<= 0.3"} for t in AGENTS]
    expect += [{"id": f"ends{t}", "name": t, "quantity": "publishers", "range": "1..1"} for t in AGENTS]
    expect += [
        {"id": f"wire{t}", "kind": "connection", "name": t, "quantity": "rate", "range": "8..12"} for t in AGENTS
    ]
    expect += [{"id": "cpu", "kind": "host", "name": "*", "quantity": "cpu", "range": "<= 80"}]
    presence = [{"id": f"node{n}", "kind": "node", "name": n, "mode": "always"} for n in NODES]
    presence += [{"id": f"host{h}", "kind": "host", "name": h, "mode": "always"} for h in ("robot", "arm", "base")]
    traffic = [
        {"topic": topic, "publisher": node, "subscriber": "/all", "from": 0, "to": until, "hz": 10,
         "sender": f"{AGENTS[topic]}/agent", "host": AGENTS[topic]}
        for node, (topic,) in PUBLISH.items()
    ]  # fmt: skip
    samples = [
        {"entity": f"host:{host}", "from": 0, "to": until, "values": {"cpu": 40}, "sender": f"{host}/agent"}
        for host in ("robot", "arm", "base")
    ]
    graph = {"at": 0, "nodes": {**NODES, "/all": "base"}, "publish": PUBLISH, "subscribe": {"/all": list(AGENTS)}}
    return {
        "expect": expect, "presence": presence, "traffic": traffic, "samples": samples,
        "graphs": [{**graph, "hosts": ["robot", "arm", "base"]}], "until": until,
        "senders": [{"name": name, **own, **senders.get(name, {})} for name, own in named.items()],
        **others,
    }  # fmt: skip


LENGTHS = (0.5, pytest.param(1.0, marks=pytest.mark.nightly), 2.0, pytest.param(5.0, marks=pytest.mark.nightly), 10.0)


@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize(
    "names",
    [["robot/agent"], ["base/ros2"], ["robot/agent", "arm/agent", "base/agent", "base/ros2"]],
    ids=["an agent", "the observer of ROS", "all"],
)
@pytest.mark.parametrize("what", ["cut", "stopped"])
def test_a_line_that_is_cut_or_an_observer_that_is_stopped(what, names, length):
    assert decided(robot({name: {what: [[15, 15 + length]]} for name in names})) == []


@pytest.mark.parametrize("what", ["cut", "stopped"])
def test_again_and_again(what):
    turns = [[at, at + 0.1 * (at % 7) + 0.3] for at in range(10, 28)]
    assert decided(robot({"robot/agent": {what: turns}, "base/ros2": {what: turns}})) == []


@pytest.mark.parametrize("length", LENGTHS)
def test_a_monitor_that_is_stopped(length):
    assert decided(robot({}, away={"from": 15, "to": 15 + length, "reads": 30})) == []


@pytest.mark.parametrize("shift", [-30, -1, 0.5, 3, 60])
def test_a_clock_that_is_set(shift):
    assert decided(robot({}, clock=[{"at": 20, "shift": shift}])) == []


def test_a_healthy_robot():
    assert decided(robot({})) == []


@pytest.mark.parametrize("name", ["silent_link", "stopped_observer", "stopped_monitor", "clock_pause", "unobserved"])
def test_every_time_line_about_who_observes(name):
    line = read(Path(__file__).parents[1] / "time_lines" / f"{name}.yaml")
    about = {(row["of"], row["id"]) for row in line["then"] if row.get("state") in ("low", "high", "absent")}
    guilty = {entity for entity, _ in about}
    assert {one.entity for one in decided(line)} <= guilty


def test_a_node_that_is_gone_is_acted_upon_and_nothing_else():
    away = dict(NODES)
    del away["/lidar"]
    line = robot({})
    first = line["graphs"][0]
    gone = {**first, "at": 20, "nodes": {**away, "/all": "base"}, "publish": {n: PUBLISH[n] for n in away}}
    line["graphs"] = [first, gone]
    line["events"] = [{"at": 20, "change": "vanished", "entity": "node:/lidar"}]
    line["traffic"][0]["to"] = 20
    found = decided(line)
    assert {one.entity for one in found if one.action.kind == "restart"} == {"node:/lidar"}
    assert {one.entity for one in found} <= {"node:/lidar", "topic:/scan", "connection:/lidar > /scan > /all"}
    assert {one.first_cause for one in found if one.reaction != "rash.not"} == {"node:/lidar"}
    assert min(one.at_s for one in found) < 20.5


def test_a_node_that_goes_while_nobody_looks_is_acted_upon_when_somebody_does():
    line = robot({"base/ros2": {"stopped": [[18, 26]]}})
    first = line["graphs"][0]
    away = {name: host for name, host in NODES.items() if name != "/lidar"}
    gone = {**first, "at": 26, "nodes": {**away, "/all": "base"}, "publish": {n: PUBLISH[n] for n in away}}
    line["graphs"] = [first, gone]
    line["traffic"][0]["to"] = 20
    found = [one for one in decided(line) if one.action.kind == "restart"]
    assert {one.entity for one in found} == {"node:/lidar"}
    assert 26 <= min(one.at_s for one in found) < 31
