"""``roslens check --changed`` with computation graphs: what is found in them counts where a changed file has it."""

import json
import os
import subprocess

import pytest

from roslens.cli.graph import graph_configurations
from roslens.cli.main import main

NODES = "talk/talk/nodes.py"


def git(folder, *arguments):
    who = {f"GIT_{role}_{what}": "a@b.c" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    environment = {**os.environ, **who, "GIT_CONFIG_GLOBAL": "/dev/null"}
    command = ["git", "-C", str(folder), "-c", "init.defaultBranch=main", *arguments]
    subprocess.run(command, check=True, capture_output=True, env=environment)


@pytest.fixture
def kept(talking):
    (talking / ".gitignore").write_text(".roslens\n")
    git(talking, "init", "-q")
    git(talking, "add", ".")
    git(talking, "commit", "-qm", "first")
    return talking


def found(root, capsys, *more, code=0):
    """Return what is found in graphs of changed files, by rule and path, and the failures."""
    assert main(["check", str(root), "--changed", "--format", "json", "--jobs", "1", "-q", *more]) == code
    report = json.loads(capsys.readouterr().out)
    graph = [one for one in report["findings"] if one["rule"].startswith("graph.")]
    return [(one["rule"], one["path"]) for one in graph], report["failures"]


def test_what_stands_in_a_changed_file_is_reported(kept, capsys):
    path = kept / NODES
    path.write_text(path.read_text() + "# again\n")
    assert found(kept, capsys, code=1) == ([("graph.qos", NODES)], [])
    assert found(kept, capsys, "--no-graph") == ([], [])
    path.write_text(path.read_text().replace("qos_profile_sensor_data)", "10)"))
    assert found(kept, capsys) == ([], [])


def test_what_stands_elsewhere_is_left_to_a_whole_run(kept, capsys):
    (kept / "talk/launch/record.launch.xml").write_text('<launch><node pkg="talk" exec="listener"/></launch>\n')
    assert [path for _, path in found(kept, capsys)[0] if path == NODES] == []


def test_a_change_of_another_branch_is_seen(kept, capsys):
    path, beside = kept / NODES, kept / "talk/talk/beside.py"
    beside.write_text("x = 1\n")
    assert found(kept, capsys) == ([], [])
    # The same file differs, and what stands beside it is another.
    path.write_text(path.read_text().replace("chatter", "chat"))
    git(kept, "add", NODES)
    git(kept, "commit", "-qm", "second")
    beside.write_text("x = 2\n")
    path.write_text(path.read_text() + "# note\n")
    assert found(kept, capsys, code=1)[0] == [("graph.qos", NODES)]


def test_no_graph_is_looked_at_where_nothing_changed(kept, capsys, monkeypatch):
    monkeypatch.setattr(graph_configurations, "chosen_configurations", None)
    assert found(kept, capsys) == ([], [])


def test_what_of_graphs_cannot_be_read_elsewhere_is_no_matter_of_the_change(kept, capsys):
    (kept / "roslens.toml").write_text('[graph.configurations.robot]\nlaunch = "talk/robot.launch.xml"\n')
    (kept / "talk/launch/robot.launch.xml").write_text("<launch/>\n")
    git(kept, "add", ".")
    git(kept, "commit", "-qm", "second")
    (kept / "talk/talk/beside.py").write_text("x = 1\n")
    assert found(kept, capsys) == ([], [])
