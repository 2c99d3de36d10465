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
    (talking / "roslens.toml").write_text(DECLARED)
    _, (one,) = report(talking, capsys, code=1)
    assert (one["rule"], one["path"], one["line"]) == ("graph.qos", "talk/talk/nodes.py", 16)
    assert report(talking, capsys, "--no-graph")[1] == []
    assert len(report(talking, capsys, "--fail-on", "never")[1]) == 1


def test_without_any_the_largest_launch_files_are_looked_at_and_what_is_left_out_is_told(talking, capsys):
    found, graph = report(talking, capsys, code=1)
    assert [one["rule"] for one in graph] == ["graph.qos"]
    graphs = found["run"]["graphs"]
    assert (graphs["looked_at"], graphs["left_out"]) == (["fleet.launch.xml"], [])
    assert graphs["completeness"]["fleet.launch.xml"] == {
        "whole": 2,
        "named": 1,
        "gaps": [{"reason": "a is not in the workspace", "nodes": 1, "packages": ["a"]}],
    }
    many(talking)
    found, graph = report(talking, capsys, "--graph", code=1)
    assert len(found["run"]["graphs"]["looked_at"]) == 8
    assert found["run"]["graphs"]["left_out"] == ["talk/launch/more0.launch.xml", "talk/launch/more1.launch.xml"]
    assert main(["check", str(talking), "--jobs", "1", "-q", "--fail-on", "never"]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "Computation graph: 8 of 10 launch files, those that together start most nodes; --graph all" in out
    found, graph = report(talking, capsys, "--graph", "all", code=1)
    assert (len(found["run"]["graphs"]["looked_at"]), found["run"]["graphs"]["left_out"]) == (10, [])
    found, graph = report(talking, capsys, "--no-graph")
    assert (graph, found["run"].get("graphs")) == ([], None)


def many(talking):
    """Write nine launch files more, of one to nine nodes."""
    for number in range(9):
        nodes = "".join(f'<node pkg="a{place}" exec="b"/>' for place in range(number + 1))
        (talking / f"talk/launch/more{number}.launch.xml").write_text(f"<launch>{nodes}</launch>")


def test_a_declared_configuration_and_every_launch_file(talking, capsys):
    (talking / "roslens.toml").write_text(DECLARED)
    assert report(talking, capsys, code=1)[0]["run"]["graphs"]["looked_at"] == ["robot"]
    assert report(talking, capsys, "--graph", "all", code=1)[0]["run"]["graphs"]["looked_at"] == [
        "robot",
        "fleet.launch.xml",
    ]


def test_a_word_behind_the_option_is_a_path(talking, capsys, monkeypatch):
    for words in (
        ["--graph", str(talking)],
        [str(talking), "--graph"],
        [str(talking), "--graph", str(talking / "talk")],
    ):
        assert main(["check", *words, "--jobs", "1", "-q", "--no-store", "--fail-on", "never"]) == 0
        assert "graph.qos" in capsys.readouterr().out
    monkeypatch.chdir(talking / "talk")
    assert main(["check", ".", "--graph", "launch", "--jobs", "1", "-q", "--no-store", "--fail-on", "never"]) == 0
    assert "graph.qos" in capsys.readouterr().out


@pytest.mark.parametrize(
    "content",
    [
        '<launch><executable cmd="ros2 bag record -a"/></launch>',
        '<launch><include file="$(find-pkg-share elsewhere)/launch/robot.launch.py"/></launch>',
        "<launch/>",
    ],
)
def test_a_launch_file_that_records_or_includes_what_is_not_here_is_no_failure(talking, capsys, content):
    for path in talking.glob("talk/**/*.launch.*"):
        path.unlink()
    (talking / "talk/launch").mkdir(exist_ok=True)
    (talking / "talk/launch/record.launch.xml").write_text(content)
    assert report(talking, capsys)[0]["failures"] == []


@pytest.mark.parametrize("command", ["ros2 bag record -a", "rviz2"])
def test_a_declared_one_that_starts_programs_alone_is_no_failure(talking, capsys, command):
    (talking / "roslens.toml").write_text(DECLARED)
    (talking / "talk/launch/robot.launch.xml").write_text(f'<launch><executable cmd="{command}"/></launch>')
    assert report(talking, capsys)[0]["failures"] == []


def test_a_declared_one_that_starts_nothing_is_a_failure(talking, capsys):
    (talking / "roslens.toml").write_text(DECLARED)
    (talking / "talk/launch/robot.launch.xml").write_text("<launch/>")
    (failure,) = report(talking, capsys, code=3)[0]["failures"]
    assert 'configuration "robot" starts no node' in failure["what"]


def test_an_argument_that_is_meant_to_be_given_is_no_error(talking, capsys):
    (talking / "talk/launch/drive.launch").write_text(
        '<launch><arg name="robot"/><node pkg="talk" type="talker" name="$(arg robot)"/></launch>'
    )
    _, graph = report(talking, capsys, "--fail-on", "never")
    assert [one["rule"] for one in graph if one["path"].endswith("drive.launch")] == []


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


def test_how_much_of_the_graphs_is_known_stands_among_what_was_not_analysed_and_fails_nothing(talking, capsys):
    found, _ = report(talking, capsys, "--fail-on", "never")
    (failure,) = found["failures"]
    assert failure["what"] == "fleet.launch.xml: 2 of 3 nodes complete, 1 known by name only"
    assert (failure["tool"], failure["partial"]) == ("graph completeness", True)
    assert main(["check", str(talking), "--jobs", "1", "-q", "--fail-on", "never"]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "Not analysed: 1 in part" in out
    assert "1 node: a is not in the workspace; roslens fetch --distro DISTRO --package a" in out


def test_files_outside_of_packages_are_no_package(talking, capsys):
    (talking / "loose.py").write_text("x = 1\n")
    found, _ = report(talking, capsys, "--fail-on", "never")
    assert [one["id"] for one in found["packages"]] == ["talk"]
    assert {one["package"] for one in found["files"]} == {"talk", "(outside packages)"}


def graph_check(root, capsys, *more):
    main(["graph", str(root), "--check", "--no-cache", "--fail-on", "never", *more])
    return capsys.readouterr()


def test_checking_a_graph_says_how_much_of_it_is_known(talking, capsys):
    robot = talking / "talk/launch/robot.launch.xml"
    robot.write_text('<launch><node pkg="talk" exec="talker"/></launch>')
    assert graph_check(talking, capsys, "--launch", "talk/robot.launch.xml").out == "nothing found\n"
    robot.write_text('<launch><node pkg="talk" exec="talker"/><node pkg="b" exec="c"/></launch>')
    shown = graph_check(talking, capsys, "--launch", "talk/robot.launch.xml")
    assert shown.out == "nothing found in what is known: 1 of 2 nodes complete, 1 known by name only\n"
    assert "1 node: b is not in the workspace" in shown.err
    robot.write_text('<launch><node pkg="b" exec="c"/></launch>')
    shown = graph_check(talking, capsys, "--launch", "talk/robot.launch.xml")
    assert shown.out == "could not be checked: 0 of 1 node complete, 1 known by name only\n"


def test_a_graph_begins_with_how_much_of_it_is_known(talking, capsys):
    main(["graph", str(talking), "--launch", "talk/fleet.launch.xml", "--no-cache"])
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].strip() == "2 of 3 nodes complete, 1 known by name only"
    main(["graph", str(talking), "--launch", "talk/fleet.launch.xml", "--no-cache", "--format", "json"])
    document = json.loads(capsys.readouterr().out)
    assert document["completeness"][0]["whole"] == 2
