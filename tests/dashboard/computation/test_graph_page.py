"""The page of the graph: picture, tables, twin, and what its address asks for."""

from __future__ import annotations

import json
import re
from types import ModuleType
from typing import Any

import msgspec
import pytest

from roslens.dashboard.computation.graph_page import alike, noise_text
from roslens.dashboard.computation.noise import DEFAULT, presets_of
from roslens.dashboard.computation.system import systems_of


def test_the_twin_holds_elements_wires_and_what_is_unresolved(client: Any) -> None:
    twin = json.loads(client.get("/computation/rover.json").content)
    assert twin["page"] == "computation"
    elements = {element["name"]: element for element in twin["elements"]}
    assert elements["/scan"]["findings"]
    assert elements["/lidar"]["place"] == "src/rover_bringup/launch/rover.launch.py:30"
    assert twin["unresolved"][0]["reason"]
    assert {row["name"] for row in twin["tables"]["endpoints"]["rows"]} >= {"/scan", "/rosout"}
    assert {row["node"] for row in twin["tables"]["nodes"]["rows"]} == {
        e["name"] for e in twin["elements"] if e["kind"] == "node"
    }


@pytest.mark.parametrize(
    ("query", "shown", "hidden"),
    [
        ("", "/scan", "/rosout"),
        ("?noise=none", "/rosout", ""),
        ("?noise=tf", "/rosout", "/tf"),
        ("?hide=/sc*", "/odom", "/scan"),
    ],
)
def test_the_address_says_what_is_drawn(client: Any, query: str, shown: str, hidden: str) -> None:
    text = client.get("/computation/rover" + query).text
    elements = {
        match[2]: " hidden" in match[1]
        for match in re.finditer(r'<a class="node [^"]*"([^>]*) data-name="([^"]+)"><title>', text)
    }
    assert elements[shown] is False
    assert not hidden or elements[hidden] is True


def test_topics_can_be_lines(client: Any) -> None:
    marks, lines = (client.get(f"/computation/rover?topics={one}").text for one in ("marks", "lines"))
    assert marks.count('<path class="" d=') > lines.count('<path class="" d=') > 0


def test_the_tables_are_in_the_page(client: Any, made_up: ModuleType) -> None:
    text = client.get("/computation/rover").text
    ends = sum(len(node.endpoints) for node in made_up.robot().nodes)
    assert text.count("<tr data-id=") == len(made_up.robot().nodes) + ends + len(made_up.robot_findings())


def test_an_unknown_configuration_is_not_there(client: Any) -> None:
    assert client.get("/computation/nothing").status_code == 404


def test_noise_is_written_as_it_is_read() -> None:
    for presets in (DEFAULT, frozenset(), frozenset({"tf", "debug"})):
        assert presets_of(noise_text(presets)) == presets


def test_configurations_that_start_the_same_nodes_stand_together(made_up):
    robot = made_up.robot()
    fewer = msgspec.structs.replace(robot, nodes=robot.nodes[:2])
    nothing = msgspec.structs.replace(robot, nodes=())
    systems = systems_of({"a": robot, "b": fewer, "c": robot, "d": nothing, "e": nothing})
    assert [[one.slug for one in group] for group in alike(systems.values())] == [["a", "c"], ["b"], ["d"], ["e"]]
