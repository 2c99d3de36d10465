"""Every command of the README and of *Commands by task* works as it stands, or, where tests must not, is understood."""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from documents.commands import ROOT, Reader, blocks, squeezed, without_comment

from roslens.cli.main import parser

DOCUMENTS = ("README.md", "docs/commands.md")
ONLY_UNDERSTOOD = {
    "roslens fetch": "asks a public server",
    "nav2": "reads what `roslens fetch` brought from a public server",
    "--tools": "starts whatever is installed",
    "--live": "watches a ROS that runs",
    "roslens run": "needs a node of the reader",
    "roslens watch --reference": "watches a ROS that runs",
    "--ros1": "watches a ROS that runs",
    "--ros2": "watches a ROS that runs",
    " live ": "watches a ROS that runs",
    "roslens top": "needs a terminal and a monitor",
    "roslens agent": "needs a monitor on another host",
    "roslens react": "watches a ROS that runs",
    "roslens history": "takes minutes; its own tests run it",
    "roslens trend": "reads what `roslens history` kept",
    "roslens compare release": "needs a release",
}
"""Part of a command, and why it is not run."""
OTHERS = ("make ", "pip ", "python3 examples/robot", "ros2 ", "chmod ", "kill ")
"""Commands of other programs; what of them is ours has tests of its own."""

pytestmark = pytest.mark.heavy


def commands() -> Iterator[str]:
    for document in DOCUMENTS:
        for block in blocks((ROOT / document).read_text("utf-8")):
            for line in block.lines if block.is_commands else ():
                command = without_comment(line).removesuffix(" &")
                if command and not command.startswith(OTHERS):
                    yield command


def reason(command: str) -> str:
    return next((why for part, why in ONLY_UNDERSTOOD.items() if part in f"{command} "), "")


RUN = [one for one in dict.fromkeys(commands()) if not reason(one)]
UNDERSTOOD = [one for one in dict.fromkeys(commands()) if reason(one)]


def test_the_example_is_what_the_change_of_the_demo_brings(tmp_path: Path) -> None:
    reader = Reader(tmp_path)
    shown = [one for one in blocks((ROOT / "README.md").read_text("utf-8")) if not one.is_commands]
    done = reader.type("sh examples/change.sh ~/demo && roslens check ~/demo --baseline HEAD --new-only --no-store -q")
    assert done.code == 1
    assert len(shown) == 1
    for block in shown:
        assert squeezed(" ".join(block.lines)) in squeezed(done.printed)


def test_no_reason_is_left_over() -> None:
    every = [f"{one} " for one in commands()]
    assert [part for part in ONLY_UNDERSTOOD if not any(part in one for one in every)] == []


@pytest.mark.parametrize("command", UNDERSTOOD)
def test_options_of_commands_that_are_not_run(command: str) -> None:
    words = shlex.split(re.sub(r"^cd \S+ && ", "", command))
    assert words[0] == "roslens"
    parser(words[1]).parse_args(words[1:])


@pytest.fixture(scope="module")
def reader(tmp_path_factory: pytest.TempPathFactory) -> Reader:
    """A reader with a workspace in a repository, a launch file, recordings and a reference under the README's names."""
    reader = Reader(tmp_path_factory.mktemp("home"))
    source = reader.home / "robot_ws/src"
    shutil.copytree(ROOT / "examples/workspace/src", source, ignore=shutil.ignore_patterns(".roslens"))
    bringup = source / "my_bringup"
    (bringup / "launch").mkdir(parents=True)
    (bringup / "package.xml").write_text(
        '<package format="3"><name>my_bringup</name><version>1.0.0</version><description>Starts it.</description>'
        '<maintainer email="a@example.org">a</maintainer><license>MIT</license>'
        "<export><build_type>ament_cmake</build_type></export></package>\n"
    )
    (bringup / "launch/robot.launch.py").write_text(
        "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n"
        "from launch_ros.actions import Node\n\n\ndef generate_launch_description():\n"
        "    return LaunchDescription([\n        DeclareLaunchArgument('sim', default_value='false'),\n"
        "        Node(package='rover_base', executable='rover_base'),\n    ])\n"
    )
    done = reader.type(
        f"cd {source} && git init -q -b main . && git add -A && git commit -qm first && git remote add origin . && "
        "git update-ref refs/remotes/origin/main HEAD && "
        "git symbolic-ref refs/remotes/origin/HEAD refs/remotes/origin/main && cd ~/roslens && "
        "python examples/recording/record.py drive.mcap && python examples/recording/record.py drive.bag"
        " && cp examples/recording/rover.yaml robot.yaml && cd ~/robot_ws/src && roslens check -q --fail-on never"
        " -o ~/roslens/other.sarif; cd ~/roslens"
    )
    assert done.code == 0, done.printed
    return reader


@pytest.mark.parametrize("command", RUN)
def test_a_command_does_what_it_says(command: str, reader: Reader) -> None:
    if " ID " in command:
        finding = reader.some_finding("~/robot_ws/src")
        command = f"cd ~/robot_ws/src && {command.replace(' ID ', f' {finding} ')} && cd ~/roslens"
    if " -o robot.yaml" in command:
        # A reader has none yet.
        command = f"mv robot.yaml kept.yaml && {command} && mv kept.yaml robot.yaml"
    done = reader.type(command)
    assert done.code in {0, 1, 3}, f"`{command}` ends with {done.code}: {done.printed[-2000:]}"
    assert "a bug:" not in done.printed


def test_the_home_is_of_the_reader(reader: Reader) -> None:
    assert reader.place == Path(reader.home, "roslens")
