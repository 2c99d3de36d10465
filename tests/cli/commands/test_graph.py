"""``roslens graph`` as a user meets it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from roslens.cli.main import main

EXAMPLE = str(Path(__file__).parents[3] / "examples" / "workspace")
NODE = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        topic = self.declare_parameter("topic", "chatter").value
        self.publisher = self.create_publisher(String, topic, 10)
        self.unknown = self.create_subscription(String, read_name(), print, 10)


def main():
    rclpy.init()
    rclpy.spin(Talker())
"""
LAUNCH = """\
<launch>
  <arg name="where" default="chatter"/>
  <node pkg="talk" exec="talker" name="$(var where)_talker" namespace="robot">
    <param name="topic" value="$(var where)"/>
  </node>
  <node pkg="robot_state_publisher" exec="robot_state_publisher" if="$(env BODY)"/>
  <node pkg="nowhere" exec="nothing" name="lost"/>
</launch>
"""
FILES = {
    "package.xml": '<package format="3"><name>talk</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>MIT</license>'
    "<export><build_type>ament_python</build_type></export></package>",
    "setup.py": "from setuptools import setup\n"
    "setup(name='talk', packages=['talk'], entry_points={'console_scripts': ['talker = talk.talker:main']})\n",
    "setup.cfg": "[install]\ninstall_scripts=$base/lib/talk\n",
    "talk/__init__.py": "",
    "talk/talker.py": NODE,
    "launch/talk.launch.xml": LAUNCH,
}


@pytest.fixture
def workspace(tmp_path: Path) -> str:
    for path, text in FILES.items():
        place = tmp_path / "talk" / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    return str(tmp_path)


def shown(capsys: pytest.CaptureFixture[str], *arguments: str, code: int = 0) -> str:
    assert main(["graph", *arguments]) == code
    return capsys.readouterr().out


def document(capsys: pytest.CaptureFixture[str], *arguments: str):
    return json.loads(shown(capsys, *arguments, "--format", "json"))["configurations"]


def test_a_launch_file_is_read_with_its_arguments(workspace, capsys):
    text = shown(capsys, workspace, "--launch", "talk/talk.launch.xml", "--arg", "where:=said")
    assert "/robot/said_talker  (talk/talker)  talk/launch/talk.launch.xml:3" in text
    assert "/robot/said" in text
    assert "set in talk/launch/talk.launch.xml:4" in text
    assert "result of read_name()" in text
    assert "package nowhere is not in the workspace" in text


def test_nodes_of_the_catalogue_and_conditions_are_marked(workspace, capsys):
    (found,) = document(capsys, workspace, "--launch", "talk/talk.launch.xml")
    body = next(one for one in found["nodes"] if one["package"] == "robot_state_publisher")
    assert body["conditions"] == ["environment BODY"] or "BODY" in body["conditions"][0]
    assert {one["proof"]["origin"] for one in body["endpoints"]} == {"catalogue"}
    assert {one["proof"]["sure"] for one in body["endpoints"]} == {"likely"}


def test_what_every_node_has_is_shown_on_request(workspace, capsys):
    launch = (workspace, "--launch", "talk/launch/talk.launch.xml", "--node", "chatter_talker")
    assert "/rosout" not in shown(capsys, *launch)
    assert "/rosout" in shown(capsys, *launch, "--all")


def test_without_a_launch_file_all_that_packages_make_is_shown(workspace, capsys):
    (found,) = document(capsys, workspace, "--package", "talk")
    assert [one["name"] for one in found["nodes"]] == ["/talker"]
    (topic,) = [one for one in found["nodes"][0]["endpoints"] if one["endpoint"]["role"] == "publisher"]
    assert (topic["endpoint"]["name"], topic["proof"]["sure"]) == ("/chatter", "likely")


def test_why_there_are_no_nodes_is_told(tmp_path, capsys):
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "package.xml").write_text('<package format="3"><name>p</name><version>1.0.0</version></package>')
    (tmp_path / "p" / "CMakeLists.txt").write_text("made_elsewhere(a b)\n")
    assert main(["graph", str(tmp_path)]) == 3
    reported = capsys.readouterr()
    assert reported.out == "no nodes\n"
    assert "p/CMakeLists.txt:1: made_elsewhere(): the command is not defined in the workspace" in reported.err


def test_a_hint_completes_what_code_cannot_tell(workspace, capsys):
    Path(workspace, "roslens.toml").write_text(
        '[graph.hints."talk/talker"]\nserves = ["~/reset std_srvs/srv/Empty"]\n'
        'names = { "talk/talk/talker.py:11" = "heard" }\n'
    )
    text = shown(capsys, workspace, "--package", "talk")
    assert "/talker/reset" in text
    assert "/heard" in text
    assert "unresolved" not in text


def test_two_launches_are_compared(workspace, capsys):
    launch = "talk/talk.launch.xml"
    assert "no difference" in shown(capsys, workspace, "--diff", launch, launch)
    text = shown(capsys, workspace, "--diff", launch, f"{launch}:where=said", code=1)
    assert "- /robot/chatter_talker  talk/talker" in text
    assert "+ /robot/said_talker  talk/talker" in text
    table = shown(capsys, workspace, "--diff", launch, f"{launch}:where=said", "--format", "markdown", code=1)
    assert "| added | `/robot/said_talker` | node |  | `talk/talker` |" in table


def test_two_documents_are_compared(workspace, tmp_path, capsys):
    names = []
    for value in ("a", "b"):
        names.append(str(tmp_path / f"{value}.json"))
        arguments = ["--launch", "talk/talk.launch.xml", "--arg", f"where:={value}"]
        shown(capsys, workspace, *arguments, "--format", "json", "-o", names[-1])
    assert "+ /robot/b_talker" in shown(capsys, workspace, "--diff", *names, code=1)


@pytest.mark.parametrize("form", ["dot", "mermaid", "nodl", "rosgraph"])
def test_every_format_tells_the_topic(workspace, capsys, form):
    assert "/robot/chatter" in shown(capsys, workspace, "--launch", "talk/talk.launch.xml", "--format", form)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--launch", "talk/tlk.launch.xml"], 'Did you mean "talk/talk.launch.xml"?'),
        (["--package", "tlk"], 'Did you mean "talk"?'),
        (["--node", "tlker"], 'no node "tlker"'),
        (["--arg", "a:=b"], "--arg without --launch"),
        (["--launch", "talk/talk.launch.xml", "--arg", "a=b"], "name:=value"),
        (["--format", "markdown"], "--format markdown without --diff"),
        (["--diff", "a.json", "b.json"], "a.json"),
    ],
)
def test_what_cannot_be_is_told(workspace, capsys, arguments, message):
    assert main(["graph", workspace, *arguments]) == 2
    assert message in capsys.readouterr().err


def test_the_example_has_nodes_of_both_generations(capsys):
    found = document(capsys, EXAMPLE, "--no-cache")
    assert [one["generation"] for one in found] == ["ros1", "ros2"]
    names = {node["name"]: node for one in found for node in one["nodes"]}
    battery = names["/battery_monitor"]
    ends = {(one["endpoint"]["role"], one["endpoint"]["name"], one["endpoint"]["type"]) for one in battery["endpoints"]}
    assert ends == {
        ("publisher", "/battery", "sensor_msgs/msg/BatteryState"),
        ("subscription", "/motor_status", "rover_msgs/msg/MotorStatus"),
    }
    assert "/docking" in names


@pytest.mark.parametrize("more", [[], ["--check"]])
def test_what_could_not_be_read_at_all_is_no_clean_graph(tmp_path, more):
    assert main(["graph", str(tmp_path), *more, "--no-cache"]) == 3
    package = tmp_path / "p" / "launch"
    package.mkdir(parents=True)
    (tmp_path / "p" / "package.xml").write_text('<package format="3"><name>p</name></package>')
    (package / "a.launch.py").write_text("def generate_launch_description(")
    assert main(["graph", str(tmp_path), "--launch", "p/a.launch.py", *more, "--no-cache"]) == 3


def test_an_argument_that_the_launch_file_does_not_declare_is_told(workspace, capsys):
    given = ["graph", workspace, "--launch", "talk/talk.launch.xml", "--arg", "wher:=there"]
    assert main(given) == 0
    reported = capsys.readouterr().err
    assert "argument `wher` is given" in reported
    assert "Did you mean `where`?" in reported
    assert main([*given, "--quiet"]) == 0
    assert capsys.readouterr().err == ""
