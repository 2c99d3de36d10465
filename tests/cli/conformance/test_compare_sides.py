"""`roslens compare` of sides, on graphs that were recorded of real robots."""

from __future__ import annotations

import json

import msgspec
import pytest
from accuracy.kept import kept_graph
from accuracy.reading import lay_out
from accuracy.system import systems
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore

from roslens.cli.conformance import observed_side
from roslens.cli.main import main

SYSTEMS = systems()


def robot(name, tmp_path, monkeypatch):
    """Lay out the source of a robot, and let the monitor at `robot:1` see what was recorded of it."""
    system = SYSTEMS[name]
    lay_out(system, tmp_path)
    monkeypatch.chdir(tmp_path)
    see(kept_graph(system), monkeypatch)
    return system


def see(graph, monkeypatch):
    monkeypatch.setattr(observed_side, "fetched", lambda address, what: msgspec.json.encode(graph))


def compare(capsys, *words):
    code = main(["compare", *words, "--format", "json", "--jobs", "1", "-q"])
    return code, json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("name", ["robot_ros2", "robot_ros1", "words_ros2"])
def test_a_real_robot_runs_as_its_source_says(name, tmp_path, monkeypatch, capsys):
    robot(name, tmp_path, monkeypatch)
    code, found = compare(capsys, ".", "robot:1")
    grave = [one for one in found["disparities"] if one["severity"] != "note"]
    assert grave == []
    assert code == 0
    assert found["agreed"]["node"] >= 4
    assert found["kinds"] == ["source", "running"]


def test_what_was_changed_since_is_found_in_the_real_robot(tmp_path, monkeypatch, capsys):
    system = robot("robot_ros2", tmp_path, monkeypatch)
    text = msgspec.json.encode(kept_graph(system))
    graph = msgspec.json.decode(
        text.replace(b"geometry_msgs/msg/PoseStamped", b"nav_msgs/msg/Path"), type=type(kept_graph(system))
    )
    without = msgspec.structs.replace(
        graph,
        nodes=tuple(one for one in graph.nodes if one.name != "/front_lidar"),
        endpoints=tuple(one for one in graph.endpoints if one.node != "/front_lidar"),
    )
    see(without, monkeypatch)
    code, found = compare(capsys, ".", "robot:1")
    assert code == 1
    grave = {
        (one["kind"], one["node"], one["aspect"], one["reason"])
        for one in found["disparities"]
        if one["severity"] == "error"
    }
    assert grave == {
        ("node", "/front_lidar", "presence", "not_running"),
        ("publisher", "/odometry", "type", "contradiction"),
        ("subscription", "/rover/planner", "type", "contradiction"),
    }
    lidar = next(one for one in found["disparities"] if one["node"] == "/front_lidar")
    assert lidar["place"].startswith("src/robot_ros2/launch/robot.launch.xml:")
    assert lidar["right"] == "the source"


def test_text_says_who_is_right_and_markdown_is_a_table(tmp_path, monkeypatch, capsys):
    robot("robot_ros2", tmp_path, monkeypatch)
    (tmp_path / "robot.yaml").write_text(
        "kind: reference\nname: robot\nconstraints:\n"
        "  - node: /{odometry,arm}\n    expected: always\n    severity: error\n"
    )
    assert main(["compare", ".", "robot:1", "robot.yaml", "--jobs", "1", "-q"]) == 1
    text = capsys.readouterr().out
    assert "✖ node /arm" in text
    assert "[robot.yaml:5]" in text
    assert "A: " in text
    assert main(["compare", "robot.yaml", "robot:1", "--format", "markdown", "-q"]) == 1
    assert "| error | `node /arm` | expected |" in capsys.readouterr().out


def recorded(path, topics):
    """Write a recording of ROS 1 with one empty message on each topic, by name with type and publisher."""
    store = get_typestore(Stores.ROS1_NOETIC)
    with Writer(path) as bag:
        for topic, (kind, publisher) in topics.items():
            connection = bag.add_connection(topic, kind, typestore=store, callerid=publisher)
            bag.write(connection, 1, b"")


def test_a_recording_is_held_against_source(tmp_path, monkeypatch, capsys):
    robot("robot_ros1", tmp_path, monkeypatch)
    lidar = "/lidar"
    recorded(
        tmp_path / "drive.bag",
        {
            "/scan": ("sensor_msgs/msg/PointCloud2", lidar),
            "/odom": ("geometry_msgs/msg/PoseStamped", "/odometry"),
            "/extra": ("sensor_msgs/msg/Image", lidar),
        },
    )
    code, found = compare(capsys, ".", "drive.bag")
    assert (code, found["kinds"]) == (1, ["source", "recording"])
    reported = {(one["kind"], one["name"], one["aspect"], one["reason"]) for one in found["disparities"]}
    assert ("publisher", "/scan", "type", "contradiction") in reported
    assert ("publisher", "/extra", "presence", "unknown_to_source") in reported
    assert ("publisher", "/cmd_vel", "presence", "not_recorded") in reported
    assert found["agreed"]["publisher"] == 1


def test_a_stored_graph_is_held_against_what_runs(tmp_path, monkeypatch, capsys):
    robot("robot_ros2", tmp_path, monkeypatch)
    assert main(["check", ".", "--graph", "-q", "--jobs", "1", "--fail-on", "never"]) == 0
    capsys.readouterr()
    code, found = compare(capsys, "now", "robot:1")
    assert code == 0
    assert found["titles"][0] == "run 1, robot.launch.xml"
    assert compare(capsys, "1:robot.launch.xml", "robot:1")[0] == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["main", "robot:1"], '"main" is nothing that can be compared'),
        (["live", "live"], '"live" twice'),
        (["robot:1", "nothing.mcap"], 'no file "nothing.mcap"'),
        (["robot:1", "now", "--launch", "x.launch.xml"], "--launch without a workspace"),
        (["robot.txt", "robot:1"], "nothing that can be compared"),
    ],
)
def test_what_is_no_side_is_refused_with_what_may_be(words, message, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "robot.txt").write_text("hello")
    assert main(["compare", *words, "-q"]) == 2
    assert message in capsys.readouterr().err


def test_nobody_at_an_address_is_told(capsys):
    assert main(["compare", "live:1", "127.0.0.1:1"]) == 2
    assert "does not answer" in capsys.readouterr().err
