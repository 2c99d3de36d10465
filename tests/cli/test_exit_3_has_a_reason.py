"""Whoever gets exit code 3 reads why: on the screen, or in the document that was asked for."""

import json

import pytest

from roslens.cli.main import main

PACKAGE = """<package format="3"><name>p</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license><depend>rclpy</depend>
<export><build_type>ament_python</build_type></export></package>"""
ELSEWHERE = """from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([Node(package="other", executable="other")])
"""
MISSING = """from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
def generate_launch_description():
    return LaunchDescription([IncludeLaunchDescription("/nowhere/of.launch.py")])
"""
WORKSPACES = {
    "empty": {},
    "no text": {"p/talk.py": bytes(range(256)) * 40},
    "nothing here": {"launch/p.launch.py": ELSEWHERE.encode()},
    "broken launch file": {"launch/p.launch.xml": b"<launch><node></launch>"},
    "included elsewhere": {"launch/p.launch.py": MISSING.encode()},
    "too deep": {"launch/p.launch.xml": b"<launch>" + b"<group>" * 2000 + b"</group>" * 2000 + b"</launch>"},
}
COMMANDS = {
    "check": ["check", "--no-store"],
    "check json": ["check", "--no-store", "--format", "json"],
    "check markdown": ["check", "--no-store", "--format", "markdown"],
    "check junit": ["check", "--no-store", "--format", "junit"],
    "check sarif": ["check", "--no-store", "--format", "sarif"],
    "graph": ["graph", "--no-store"],
    "graph json": ["graph", "--no-store", "--format", "json"],
    "graph check": ["graph", "--no-store", "--check"],
    "graph check json": ["graph", "--no-store", "--check", "--format", "json"],
}
LAUNCHED = {name: [*words, "--launch"] for name, words in COMMANDS.items() if words[0] == "graph"}


def why(written, errors):
    """Return what tells a reader why something is missing."""
    if errors.strip():
        return errors
    if not written.lstrip().startswith("{"):
        return written
    document = json.loads(written)
    return [
        *document.get("failures", ()),
        *(one for each in document.get("configurations", ()) for one in each.get("unresolved", ())),
        *(one for each in document.get("runs", ()) for one in each.get("invocations", ())),
        *([document["completeness"]] if document.get("completeness") else ()),
    ]


@pytest.fixture
def folder(tmp_path, request):
    (tmp_path / "package.xml").write_text(PACKAGE)
    for path, content in WORKSPACES[request.param].items():
        (tmp_path / path).parent.mkdir(exist_ok=True)
        (tmp_path / path).write_bytes(content)
    return tmp_path


@pytest.mark.parametrize("quiet", [(), ("-q",)], ids=["", "quiet"])
@pytest.mark.parametrize("words", COMMANDS.values(), ids=COMMANDS)
@pytest.mark.parametrize("folder", WORKSPACES, indirect=True)
def test_a_workspace_that_is_not_analysed_as_a_whole(folder, words, quiet, capsys):
    code = main([*words, *quiet, str(folder)])
    reported = capsys.readouterr()
    assert code != 3 or why(reported.out, reported.err), reported.out


@pytest.mark.parametrize("quiet", [(), ("-q",)], ids=["", "quiet"])
@pytest.mark.parametrize("words", LAUNCHED.values(), ids=LAUNCHED)
@pytest.mark.parametrize("folder", [one for one in WORKSPACES if "launch/" in "".join(WORKSPACES[one])], indirect=True)
def test_a_launch_file_that_is_not_analysed_as_a_whole(folder, words, quiet, capsys):
    (launch,) = (folder / "launch").iterdir()
    code = main([*words, f"{launch}", *quiet, str(folder)])
    reported = capsys.readouterr()
    assert code != 3 or why(reported.out, reported.err), reported.out


def test_what_was_to_be_compared_and_is_not_there(tmp_path, capsys):
    (tmp_path / "package.xml").write_text(PACKAGE)
    for words in (["check", "--baseline", "nosuch"], ["check", "--baseline", "nosuch", "-q", "--format", "json"]):
        assert main([*words, str(tmp_path)]) in (2, 3)
        assert capsys.readouterr().err.strip()
