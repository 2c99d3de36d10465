"""Two robots from one launch file: what is wrong with both is shown at both."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from roslens.cli.main import main

ROBOT = """\
<launch>
  <node pkg="talk" exec="talker">
    <remap from="/nothing" to="x"/>
    <param from="$(find-pkg-share talk)/config/a.yaml"/>
  </node>
  <node pkg="talk" exec="listener"/>
</launch>
"""
GROUP = """<group><push-ros-namespace namespace="{}"/>
<include file="$(find-pkg-share talk)/launch/robot.launch.xml"/></group>"""


@pytest.fixture
def pages(talking: Path, tmp_path: Path) -> Path:
    """Return the folder with the nodes' pages of two robots."""
    launch = talking / "talk/launch"
    (launch / "robot.launch.xml").write_text(ROBOT)
    (launch / "two.launch.xml").write_text(f"<launch>{GROUP.format('robot1')}{GROUP.format('robot2')}</launch>")
    (talking / "talk/config").mkdir()
    (talking / "talk/config/a.yaml").write_text("/talker:\n  ros__parameters:\n    rate: 3\n")
    (talking / "roslens.toml").write_text('[graph.configurations.two]\nlaunch = "talk/two.launch.xml"\n')
    assert main(["check", str(talking), "-q", "--jobs", "1", "--fail-on", "never"]) == 0
    assert main(["report", str(talking), "-o", str(tmp_path / "out"), "-q"]) == 0
    return tmp_path / "out"


def test_each_robot_has_the_same_findings(pages: Path) -> None:
    first, second = (
        json.loads((pages / f"nodes/two/{robot}/talker.json").read_text())["findings"] for robot in ("robot1", "robot2")
    )
    assert {"graph.remap", "graph.parameter_file"} <= {one["rule"] for one in first}
    assert [one["rule"] for one in first] == [one["rule"] for one in second]


def test_each_robot_is_marked_on_the_graph(pages: Path) -> None:
    elements = json.loads((pages / "computation/two.json").read_text())["elements"]
    severity = {one["name"]: one["severity"] for one in elements}
    assert severity["/robot1/talker"] == severity["/robot2/talker"] == "error"
    assert severity["/robot1/chatter"] == severity["/robot2/chatter"] == "error"
