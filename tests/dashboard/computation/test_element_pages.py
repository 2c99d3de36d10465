"""Pages of nodes and topics."""

from __future__ import annotations

import json
from typing import Any

import pytest

from roslens.dashboard.computation.book import Book
from roslens.dashboard.computation.element_pages import build_node
from roslens.dashboard.computation.system import systems_of
from roslens.dashboard.view import Request
from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter, Proof


def rows(client: Any, address: str) -> dict[str, list[dict[str, Any]]]:
    twin = json.loads(client.get(address + ".json").content)
    return {name: table["rows"] for name, table in twin["tables"].items()}


def test_a_node_tells_its_interface(client: Any) -> None:
    found = rows(client, "/nodes/rover/navigation/planner")
    assert [row["name"] for row in found["publishes"]] == ["/cmd_vel", "/navigation/debug/costs", "/navigation/plan"]
    assert found["publishes"][0]["more"] == "remapped at src/rover_bringup/launch/rover.launch.py:43"
    assert found["publishes"][1]["conditions"] == "debug_"
    assert [row["name"] for row in found["subscribes"]] == ["/odom", "/scan", "/tf"]
    assert found["subscribes"][1]["callback"] == "Planner::on_scan"
    assert [(row["does"], row["name"]) for row in found["serves"]] == [("serves (action)", "/navigation/navigate")]
    assert [row["sure"] for row in found["calls"]] == ["likely"]
    assert found["parameters"][0]["set_by"] == "src/rover_bringup/config/rover.yaml:4"
    assert len(found["implicit"]) == 6


def test_a_timer_is_told_with_its_rate(client: Any) -> None:
    assert rows(client, "/nodes/rover/odometry")["timers"][0]["rate"] == 50


def test_a_topic_tells_who_is_at_which_end(client: Any) -> None:
    found = rows(client, "/topics/rover/topic/scan")
    assert [(row["node"], row["qos"]) for row in found["publishers"]] == [
        ("/lidar", "best effort, volatile, keep last 5")
    ]
    assert [(row["node"], row["qos"]) for row in found["subscriptions"]] == [
        ("/navigation/planner", "reliable, volatile, keep last 10")
    ]
    page = client.get("/topics/rover/topic/scan").text
    assert "nothing arrives" in page
    assert "No node of this configuration subscribes." in client.get("/topics/rover/topic/status").text


def test_a_component_is_linked_with_its_container(client: Any) -> None:
    assert 'href="/nodes/rover/container"' in client.get("/nodes/rover/left/camera").text
    assert "/left/camera, /right/camera" in client.get("/nodes/rover/container").text


@pytest.mark.parametrize(
    "path",
    [
        "/nodes/rover/nothing",
        "/nodes/other/lidar",
        "/topics/rover/topic/rosout",
        "/topics/rover/node/lidar",
        "/nodes/rover",
    ],
)
def test_what_has_no_page_is_not_there(client: Any, path: str) -> None:
    assert client.get(path).status_code == 404


def test_overrides_that_nobody_sets_have_a_table_of_their_own() -> None:
    where = Proof("a.cpp", 3)
    name = "qos_overrides./a.publisher.depth"
    parameters = tuple(
        ConfiguredParameter(one, "1", "int", access="declared", proof=where, set_by=by)
        for one, by in (("rate", None), (name, None), (f"{name}_set", where))
    )
    node = ConfiguredNode("/n", where, parameters=parameters)
    systems = systems_of({"c": Configuration("c", "ros2", nodes=(node,))}, {})
    view = build_node(Book(systems, lambda _: False, ""), Request("c/n"))
    assert view is not None
    found = {table.name: [row[0].value for row in table.rows] for table in view.tables}
    assert found["parameters"] == ["rate", f"{name}_set"]
    assert found["overrides"] == [name]


def test_what_a_declaration_says_of_a_parameter_is_told() -> None:
    where = Proof("a.cpp", 3)
    parameters = (
        ConfiguredParameter(
            "mode", "fast", "string", access="declared", proof=where, description="How to move", read_only=True,
            allowed=("fast", "slow"), constraints=("not empty",),
        ),
        ConfiguredParameter("other", "1", "int", access="declared", proof=where, dynamic=True, range="0..5"),
    )  # fmt: skip
    node = ConfiguredNode("/n", where, parameters=parameters)
    systems = systems_of({"c": Configuration("c", "ros2", nodes=(node,))}, {})
    view = build_node(Book(systems, lambda _: False, ""), Request("c/n"))
    assert view is not None
    (table,) = [table for table in view.tables if table.name == "parameters"]
    keys = [column.key for column in table.columns]
    found = [{key: cell.value for key, cell in zip(keys, row, strict=True)} for row in table.rows]
    assert [(one["terms"], one["range"], one["description"]) for one in found] == [
        ("read only; one of fast, slow; not empty", "", "How to move"),
        ("of any type", "0..5", ""),
    ]


@pytest.mark.parametrize(
    ("defined", "said"),
    [(None, "Not known: its source was not found in this workspace."), (Proof("a.cpp", 3), "None.")],
)
def test_of_a_node_without_source_it_is_not_said_that_it_publishes_nothing(defined: Proof | None, said: str) -> None:
    node = ConfiguredNode("/n", Proof("a.launch", 3), defined=defined)
    systems = systems_of({"c": Configuration("c", "ros2", nodes=(node,))}, {})
    view = build_node(Book(systems, lambda _: False, ""), Request("c/n"))
    assert view is not None
    assert {table.empty for table in view.tables if table.name in ("publishes", "subscribes", "serves", "calls")} == {
        said
    }
