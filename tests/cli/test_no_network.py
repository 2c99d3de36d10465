"""Nothing is downloaded and nothing leaves the machine: no command on a workspace opens a connection."""

import shutil
import socket
from pathlib import Path

import pytest

from roslens.cli.main import main

EXAMPLE = Path(__file__).parents[2] / "examples"


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """Return a workspace, where every connection and every question for a host fails the test."""
    package = tmp_path / "ws" / "arm"
    (package / "launch").mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>'
        '<maintainer email="a@example.org">a</maintainer><license>MIT</license><url>http://example.org</url></package>'
    )
    (package / "CMakeLists.txt").write_text("project(arm)\nfind_package(ament_cmake REQUIRED)\nament_package()\n")
    (package / "node.cpp").write_text("int main() { return 0; }\n")
    (package / "launch" / "arm.launch.xml").write_text('<launch><node pkg="arm" exec="node"/></launch>')

    def refused(*words, **_):
        pytest.fail(f"a connection: {words}")

    for name in ("connect", "connect_ex", "sendto"):
        monkeypatch.setattr(socket.socket, name, refused)
    for name in ("getaddrinfo", "gethostbyname", "create_connection"):
        monkeypatch.setattr(socket, name, refused)
    monkeypatch.chdir(tmp_path)
    return tmp_path / "ws"


def test_no_command_on_a_workspace_opens_a_connection(workspace, capsys):
    words = [
        ["check", str(workspace), "--jobs", "1"],
        ["graph", str(workspace)],
        ["report", str(workspace), "-o", "pages"],
        ["evidence", "arm", "--workspace", str(workspace)],
        ["explain", "ros.comment_ratio.min"],
    ]
    for command in words:
        assert main(command) in (0, 1, 3), (command, capsys.readouterr())
    assert shutil.which("git") is None or not (workspace / ".git").exists()
