"""What is drawn of a configuration, and how long that takes."""

from __future__ import annotations

import time
from types import ModuleType

import pytest
from msgspec.structs import replace
from pace import turned_s

from roslens.dashboard.computation.picture import (
    Left,
    Line,
    computation_graph,
    grounds_of,
    parts_in,
    style_of,
    visible_of,
)
from roslens.dashboard.computation.system import System


@pytest.fixture(scope="module")
def system(made_up: ModuleType) -> System:
    return System("rover", made_up.robot())


def names(system: System, numbers: set[int]) -> set[str]:
    return {system.elements[number].name for number in numbers}


def test_noise_is_left_out_until_asked_for(system: System) -> None:
    shown = names(system, visible_of(system, Left()))
    assert {"/scan", "/tf", "/navigation/debug/costs", "/lidar"} <= shown
    assert not {"/rosout", "/parameter_events", "/lidar/set_parameters"} & shown
    everything = visible_of(system, Left(frozenset()))
    assert everything == set(range(len(system.elements)))


def test_presets_and_patterns_leave_out_what_they_say(system: System) -> None:
    before = names(system, visible_of(system, Left()))
    tf = names(system, visible_of(system, Left(Left().presets | {"tf"})))
    assert before - tf == {"/tf"}
    left = names(system, visible_of(system, Left(patterns=("/left",))))
    assert before - left == {"/left/camera", "/left/image_raw", "/left/camera_info"}


def test_lines_stand_for_the_topics_between_two_nodes(system: System) -> None:
    graph = computation_graph(system)
    found = {
        (graph.marks[flow.source].name, graph.marks[flow.target].name): {graph.marks[one].name for one in flow.by}
        for flow in graph.flows
    }
    assert found["/odometry", "/navigation/planner"] == {"/odom", "/tf"}
    assert found["/navigation/planner", "/odometry"] == {"/cmd_vel", "/odometry/reset"}
    assert set(graph.lines.places) == {number for number, mark in enumerate(graph.marks) if mark.kind == "node"}


def test_every_visible_element_has_a_place_and_every_wire_between_them_a_path(system: System) -> None:
    graph = computation_graph(system)
    assert set(graph.topics.places) == visible_of(system, Left())
    drawn = {graph.wires[number] for number, _ in graph.topics.lines}
    assert drawn == {
        wire for wire in graph.wires if {wire.source, wire.target} <= set(graph.topics.places) and not wire.implicit
    }
    assert not graph.many


def test_what_runs_finds_its_place_by_its_name(system: System) -> None:
    graph, parts = computation_graph(system), parts_in(system)
    for ground, drawing in zip(grounds_of(system)[:2], (graph.topics, graph.lines), strict=True):
        found = {parts[number].key: place for number, place in drawing.places.items()}
        assert {key: (stand.x, stand.y) for key, stand in ground.stands.items()} == found
    assert "node:/lidar" in ground.stands


def test_styles() -> None:
    assert style_of(Line(0, 1)) == ""
    assert style_of(Line(0, 1, conditional=True, resolved=False, sure="likely")) == "conditional unresolved likely"


@pytest.mark.timed
def test_a_large_system_takes_less_than_a_second(made_up: ModuleType) -> None:
    large = made_up.large()
    begun = time.process_time()
    graph = computation_graph(System("large", large))
    took = turned_s(begun)
    assert graph.many
    assert took < 1.0, f"{took:.2f} s"


def test_topics_stand_on_the_machine_that_publishes_them(made_up: ModuleType) -> None:
    robot = made_up.robot()
    nodes = tuple(replace(one, machine="arm") if one.name == "/lidar" else one for one in robot.nodes)
    system = System("rover", replace(robot, nodes=nodes))
    lanes = {part.key: part.lane for part in parts_in(system)}
    assert lanes["node:/lidar"] == lanes["topic:/scan"] == "/@arm"
    assert lanes["node:/odometry"] == lanes["topic:/odom"] == lanes["service:/odometry/reset"] == "/@of the launch"
    assert lanes["topic:/rosout"] == "/", "nodes of both publish it"
    assert {part.lane for part in parts_in(System("rover", robot)) if part.key == "topic:/scan"} == {"/"}
