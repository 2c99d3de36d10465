"""``roslens check`` with the computation graphs of configurations."""

import json

import pytest

from roslens.cli.main import main

DECLARED = '[graph.configurations.robot]\nlaunch = "talk/robot.launch.xml"\n'


def report(root, capsys, *more, code=0):
    assert main(["check", str(root), "--format", "json", "--jobs", "1", "-q", *more]) == code
    found = json.loads(capsys.readouterr().out)
    return found, [one for one in found["findings"] if one["rule"].startswith("graph.")]


def test_declared_configurations_are_looked_at(talking, capsys):
    assert report(talking, capsys)[1] == []
    (talking / "roslens.toml").write_text(DECLARED)
    _, (one,) = report(talking, capsys, code=1)
    assert (one["rule"], one["path"], one["line"]) == ("graph.qos", "talk/talk/nodes.py", 16)
    assert report(talking, capsys, "--no-graph")[1] == []
    assert len(report(talking, capsys, "--fail-on", "never")[1]) == 1


def test_without_any_every_first_launch_file_on_request(talking, capsys):
    assert [one["rule"] for one in report(talking, capsys, "--graph", code=1)[1]] == ["graph.qos"]


def test_the_answer_is_kept_until_a_file_changes(talking, capsys):
    path = talking / "talk/talk/nodes.py"
    report(talking, capsys, "--graph", code=1)
    assert len(report(talking, capsys, "--graph", code=1)[1]) == 1
    path.write_text(path.read_text().replace("qos_profile_sensor_data)", "10)"))
    assert report(talking, capsys, "--graph")[1] == []


def test_a_declared_launch_file_that_is_missing_is_told_and_nothing_else_lost(talking, capsys):
    (talking / "roslens.toml").write_text(DECLARED + '[graph.configurations.lost]\nlaunch = "talk/rbot.launch.xml"\n')
    found, graph = report(talking, capsys, "--fail-on", "never", code=3)
    assert len(graph) == 1
    (failure,) = found["failures"]
    assert 'configuration "lost": no launch file "talk/rbot.launch.xml"' in failure["what"]
    assert "talk/robot.launch.xml" in failure["advice"]


def test_who_disables_the_rules_gets_none(talking, capsys):
    (talking / "roslens.toml").write_text('disable = ["graph"]\n' + DECLARED)
    assert report(talking, capsys)[1] == []


@pytest.mark.parametrize("text", ["launh = 'a'", "arguments = {}", "launch = 3"])
def test_a_wrong_declaration_is_told(talking, capsys, text):
    (talking / "roslens.toml").write_text(f"[graph.configurations.robot]\n{text}\n")
    assert main(["check", str(talking), "-q"]) == 2
    assert "roslens.toml" in capsys.readouterr().err
