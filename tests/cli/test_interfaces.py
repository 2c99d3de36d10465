"""``roslens interfaces`` and what other commands report about interfaces, as a user meets it."""

import json
import os
import subprocess

import pytest

from roslens.cli.main import main

MANIFEST = """<package format="3"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license>{more}
<export><build_type>{build}</build_type></export></package>
"""
NODE = """import rclpy
from rclpy.node import Node
from rover_msgs.msg import State


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(State, "state", 10)


def main():
    rclpy.init()
    rclpy.spin(Talker())
"""
SETUP = (
    "from setuptools import setup\nsetup(name='talk', packages=['talk'], entry_points={'console_scripts': "
    "['talker = talk.nodes:main']})\n"
)
FILES = {
    "rover_msgs/package.xml": MANIFEST.format(name="rover_msgs", build="ament_cmake", more=""),
    "rover_msgs/msg/State.msg": 'int32 speed\nfloat64 heading 0.5\nstring name "a b"\n',
    "rover_msgs/srv/Go.srv": "uint8 FAST=1\nuint8 how\n---\nbool ok\n",
    "talk/package.xml": MANIFEST.format(name="talk", build="ament_python", more="<depend>rover_msgs</depend>"),
    "talk/setup.py": SETUP,
    "talk/talk/__init__.py": "",
    "talk/talk/nodes.py": NODE,
}
REFERENCE = """kind: reference
name: rover
fields:
  - topic: /state
    field: speed
    range: 0..5
"""


def git(root, *arguments):
    who = {f"GIT_{role}_{what}": "a@b.c" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    environment = {**os.environ, **who, "GIT_CONFIG_GLOBAL": "/dev/null"}
    subprocess.run(["git", "-C", str(root), "-c", "init.defaultBranch=main", *arguments], check=True, env=environment)


@pytest.fixture
def rover(tmp_path, monkeypatch):
    """Return a workspace with a release, of which a message is other in the files as they are."""
    for path, text in FILES.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-qm", "before")
    git(tmp_path, "tag", "1.0.0")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _retype(root):
    place = root / "rover_msgs/msg/State.msg"
    place.write_text(place.read_text().replace("int32 speed", "int64 velocity"))


def test_all_are_listed_with_their_hash(rover, capsys):
    assert main(["interfaces", str(rover)]) == 0
    first, second = capsys.readouterr().out.splitlines()
    assert first.startswith("rover_msgs/msg/State  RIHS01_")
    assert second.startswith("rover_msgs/srv/Go  RIHS01_")


def test_a_lock_that_was_written_is_kept(rover, capsys):
    assert main(["interfaces", "--lock", "interfaces.lock"]) == 0
    assert main(["interfaces", "--since", "interfaces.lock"]) == 0
    assert "no interface changed" in capsys.readouterr().out


def test_a_change_is_reported_with_who_breaks(rover, capsys):
    (rover / "robot.yaml").write_text(REFERENCE)
    _retype(rover)
    assert main(["interfaces", "--since", "1.0.0", "--jobs", "1", "--reference", "robot.yaml", "--format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert [(one["interface"], one["what"]) for one in found["changes"]] == [
        ("rover_msgs/msg/State", "field speed removed"),
        ("rover_msgs/msg/State", "field velocity added"),
    ]
    assert [(one["kind"], one["name"], one["how"]) for one in found["users"]] == [
        ("node", "/talker", "publishes /state"),
        ("reference", "robot.yaml", "checks speed of /state"),
    ]
    assert [(one["least"], one["enough"]) for one in found["versions"]] == [("2.0.0", False)]


def test_a_version_that_says_so_is_enough(rover, capsys):
    _retype(rover)
    asked = ["interfaces", "--since", "1.0.0", "--jobs", "1", "--fail-on", "unversioned"]
    assert main(asked) == 1
    manifest = rover / "rover_msgs/package.xml"
    manifest.write_text(manifest.read_text().replace("1.0.0", "2.0.0"))
    assert main(asked) == 0
    assert "1.0.0 -> 2.0.0, as these changes ask for" in capsys.readouterr().out


@pytest.mark.parametrize(
    "text", ["{}", "no JSON", '{"schema": "other/1", "versions": {}, "interfaces": {}}', "[" * 9000]
)
def test_what_is_no_lock_is_refused(rover, capsys, text):
    (rover / "interfaces.lock").write_text(text)
    assert main(["interfaces", "--since", "interfaces.lock"]) == 2
    assert "interfaces.lock is no lock file of interfaces" in capsys.readouterr().err


def test_a_file_that_rosidl_refuses_is_never_a_clean_result(rover, capsys):
    (rover / "rover_msgs/msg/State.msg").write_text(f"int32[{'9' * 5000}] a\n")
    assert main(["interfaces", "--since", "1.0.0"]) == 3
    assert "rover_msgs/msg/State.msg:1:1: not understood completely" in capsys.readouterr().out


def test_check_reports_what_breaks_since_a_baseline_and_its_gate_fails(rover, capsys):
    _retype(rover)
    asked = ["check", str(rover), "--baseline", "1.0.0", "--jobs", "1", "--fail-on", "never", "--no-store"]
    assert main(asked) == 0
    assert "field speed removed" in capsys.readouterr().err
    (rover / "roslens.toml").write_text("[gate]\nnew_breaking_interfaces = 0\n")
    assert main(asked) == 1
    assert "1 new breaking interface, at most 0: rover_msgs/msg/State" in capsys.readouterr().out


def test_compare_of_revisions_has_it_too(rover, capsys):
    _retype(rover)
    git(rover, "commit", "-qam", "after")
    assert main(["compare", "1.0.0", "HEAD", "--fail-on", "warning"]) == 1
    assert "field velocity added (another type on the wire)" in capsys.readouterr().out
