"""A reference drafted from a stored run: what the launch file of its workspace is sure to start."""

import pytest

from roslens.cli.graph.run_graph import graph_of_run, names_run, sure_graph
from roslens.cli.main import main
from roslens.model.errors import UsageError
from testbed.configured import configuration, end, node


@pytest.fixture
def checked(talking, monkeypatch):
    (talking / "talk/test/test.launch.xml").unlink()
    monkeypatch.chdir(talking)
    assert main(["check", "-q", "--jobs", "1", "--no-graph", "--fail-on", "never"]) == 0
    return talking


def test_what_a_run_starts_is_expected(checked, capsys, tmp_path):
    draft = tmp_path / "draft.yaml"
    assert main(["reference", "draft", "--graph", "1", "-o", str(draft)]) == 0
    text = draft.read_text()
    assert "node: /talker" in text
    assert "topic: /chatter" in text
    assert "run 1, fleet.launch.xml" in text
    assert "/rosout" not in text
    assert main(["reference", "check", str(draft)]) == 0


def test_one_of_several_configurations_is_named(checked, capsys):
    (checked / "talk/launch/alone.launch.xml").write_text('<launch><node pkg="talk" exec="talker"/></launch>')
    assert main(["check", "-q", "--jobs", "1", "--no-graph", "--fail-on", "never"]) == 0
    capsys.readouterr()
    assert main(["reference", "draft", "--graph", "2"]) == 2
    assert "2 configurations: alone.launch.xml, fleet.launch.xml" in capsys.readouterr().err
    assert main(["reference", "draft", "--graph", "2:robot"]) == 2
    assert "expected one of alone.launch.xml, fleet.launch.xml" in " ".join(capsys.readouterr().err.split())
    assert main(["reference", "draft", "--graph", "2:alone.launch.xml"]) == 0
    text = capsys.readouterr().out
    assert ("/talker" in text, "/listener" in text) == (True, False)


def test_files_that_changed_since_are_another_run(checked, capsys):
    (checked / "talk/talk/nodes.py").write_text("")
    assert main(["reference", "draft", "--graph", "1"]) == 2
    assert "talk/talk/nodes.py changed since run 1" in capsys.readouterr().err


def test_a_run_that_keeps_its_graphs_needs_no_files(talking, monkeypatch, capsys):
    (talking / "talk/test/test.launch.xml").unlink()
    monkeypatch.chdir(talking)
    assert main(["check", "-q", "--jobs", "1", "--graph", "--fail-on", "never"]) == 0
    (talking / "talk/talk/nodes.py").write_text("")
    found = graph_of_run("1")
    assert {node.name for node in found.graph.nodes} >= {"/talker"}
    assert found.source.startswith("run 1, fleet.launch.xml")
    with pytest.raises(UsageError, match="no configuration 'robot'"):
        graph_of_run("1:robot")


def test_a_run_that_is_not_there_is_told(checked, capsys):
    assert main(["reference", "draft", "--graph", "7"]) != 0
    assert "there is no run 7" in capsys.readouterr().err


def test_without_a_store_it_is_told_what_to_do(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UsageError, match="no finished run"):
        graph_of_run("1")


@pytest.mark.parametrize(("text", "run"), [("3", True), ("3:drive", True), ("graph.yaml", False), ("x:3", False)])
def test_numbers_are_runs_and_everything_else_is_a_file(text, run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert names_run(text) is run
    (tmp_path / text).touch()
    assert names_run(text) is False


def test_only_what_is_sure_is_expected():
    graph, unsure = sure_graph(
        configuration(
            node("/sure", end("pub", "/scan"), end("pub", "/*/odd", resolved=False)),
            node("/perhaps", end("pub", "/rare"), conditions=("$(var on)",)),
            node("/new", end("pub", "/other"), anonymous=True),
            node("/*/robot", resolved=False),
            node("/rviz.sh", kind="process"),
        )
    )
    assert [one.name for one in graph.nodes] == ["/sure"]
    assert [one.name for one in graph.endpoints] == ["/scan"]
    assert unsure == ("/*/robot", "/new", "/perhaps")
