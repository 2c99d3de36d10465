"""``roslens graph --check`` as a user meets it."""

import json
from pathlib import Path

import pytest

from roslens.cli.main import main

EXAMPLE = Path(__file__).parents[2] / "examples" / "workspace"
NODE = """\
import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.rate = self.declare_parameter("rate", 1.0).value
        self.publisher = self.create_publisher(String, "chatter", qos_profile_sensor_data)


class Listener(Node):
    def __init__(self):
        super().__init__("listener")
        self.subscription = self.create_subscription(String, "chatter", print, 10)


def talk():
    rclpy.init()
    rclpy.spin(Talker())


def listen():
    rclpy.init()
    rclpy.spin(Listener())
"""
LAUNCH = """\
<launch>
  <arg name="robot"/>
  <node pkg="talk" exec="talker" name="talker">
    <param name="rate" value="5"/>
  </node>
  <node pkg="talk" exec="listener" name="listener"/>
  <node pkg="talk" exec="listner" name="other"/>
</launch>
"""
FILES = {
    "package.xml": '<package format="3"><name>talk</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>MIT</license>'
    "<export><build_type>ament_python</build_type></export></package>",
    "setup.py": "from setuptools import setup\nsetup(name='talk', packages=['talk'], entry_points={'console_scripts': "
    "['talker = talk.nodes:talk', 'listener = talk.nodes:listen']})\n",
    "setup.cfg": "[install]\ninstall_scripts=$base/lib/talk\n",
    "talk/__init__.py": "",
    "talk/nodes.py": NODE,
    "launch/talk.launch.xml": LAUNCH,
}


@pytest.fixture
def workspace(tmp_path):
    for path, text in FILES.items():
        place = tmp_path / "talk" / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    return str(tmp_path)


def found(workspace, capsys, *more):
    code = main(["graph", workspace, "--launch", "talk/talk.launch.xml", "--check", "--format", "json", *more])
    return code, {(one["rule"], one["path"], one["line"]) for one in json.loads(capsys.readouterr().out)}


def test_everything_is_found_at_its_place(workspace, capsys):
    code, findings = found(workspace, capsys)
    assert code == 1
    assert findings >= {
        ("graph.qos", "talk/talk/nodes.py", 17),
        ("graph.parameter_type", "talk/launch/talk.launch.xml", 4),
        ("graph.executable", "talk/launch/talk.launch.xml", 7),
        ("graph.dependency", "talk/talk/nodes.py", 17),
    }
    assert "graph.argument" not in {rule for rule, _, _ in findings}, "it may be meant to be included"


def test_a_start_that_lacks_an_argument_is_a_finding(workspace, capsys):
    _, findings = found(workspace, capsys, "--arg", "speed:=1")
    assert ("graph.argument", "talk/launch/talk.launch.xml", 2) in findings
    config = Path(workspace, "roslens.toml")
    config.write_text('[graph.configurations.talk]\nlaunch = "talk/talk.launch.xml"\n')
    assert main(["graph", workspace, "--launch", "talk", "--check", "--fail-on", "never"]) == 0
    assert "argument `robot` must be given" in capsys.readouterr().out
    main(["check", workspace, "--format", "json", "--fail-on", "never", "--no-store", "--no-cache", "-q"])
    report = json.loads(capsys.readouterr().out)
    assert any(one["rule"] == "graph.argument" for one in report["findings"])


def test_a_missing_argument_is_told_beside_a_check(workspace, capsys):
    main(["graph", workspace, "--launch", "talk/talk.launch.xml", "--check"])
    assert "argument `robot` must be given" in capsys.readouterr().err


def test_a_system_that_is_whole_is_held_to_it(workspace, capsys):
    nodes = Path(workspace, "talk/talk/nodes.py")
    nodes.write_text(nodes.read_text().replace('Subscription(String, "chatter"', 'Subscription(String, "gossip"'))
    nodes.write_text(nodes.read_text().replace('subscription(String, "chatter"', 'subscription(String, "gossip"'))
    Path(workspace, "talk/launch/talk.launch.xml").write_text(LAUNCH.replace("listner", "talker"))
    config = Path(workspace, "roslens.toml")
    severities = []
    for whole in ("false", "true"):
        config.write_text(f'[graph.configurations.talk]\nlaunch = "talk/talk.launch.xml"\nwhole = {whole}\n')
        for command in (["graph", workspace, "--launch", "talk", "--check"], ["check", workspace, "--no-store"]):
            main([*command, "--format", "json", "--fail-on", "never", "--no-cache", "-q"])
            report = json.loads(capsys.readouterr().out)
            findings = report["findings"] if isinstance(report, dict) else report
            severities.append([one["severity"] for one in findings if one["entity"] == "topic:/gossip"])
    assert severities == [["note"], ["note"], ["warning"], ["warning"]]


def test_what_is_given_is_no_finding_and_nothing_fails_on_never(workspace, capsys):
    code, findings = found(workspace, capsys, "--arg", "robot:=a", "--fail-on", "never")
    assert code == 0
    assert "graph.argument" not in {rule for rule, _, _ in findings}


def test_lines_for_people(workspace, capsys):
    assert main(["graph", workspace, "--launch", "talk/talk.launch.xml", "--check"]) == 1
    said = capsys.readouterr()
    lines = said.out.splitlines()
    order = [("error", "warning", "note").index(line.split(": ")[1]) for line in lines]
    assert order == sorted(order)
    assert len(set(order)) > 1
    assert any(line.startswith("talk/talk/nodes.py:17: error: /listener ") and "[graph.qos]" in line for line in lines)
    errors = sum(": error: " in line for line in lines)
    assert f"roslens: {errors} errors, " in said.err
    assert "; --fail-on error" in said.err


def test_options_that_do_not_go_together(workspace, capsys):
    assert main(["graph", workspace, "--fail-on", "note"]) == 2
    assert main(["graph", workspace, "--check", "--format", "dot"]) == 2
    assert "with --check" in capsys.readouterr().err


def test_the_example_fits_together(capsys):
    assert main(["graph", str(EXAMPLE), "--launch", "rover_bringup/rover.launch.py", "--check", "--no-cache"]) == 0
    assert "error" not in capsys.readouterr().out
