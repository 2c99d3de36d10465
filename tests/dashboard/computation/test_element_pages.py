"""Pages of nodes and topics."""

from __future__ import annotations

import json
from typing import Any

import pytest


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
    assert "Nobody subscribes." in client.get("/topics/rover/topic/status").text


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
