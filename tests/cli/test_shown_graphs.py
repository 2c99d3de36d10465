"""The computation graphs among the pages of ``roslens report``."""

import json
import shutil

from roslens.cli.main import main


def pages(root, out, capsys, *more):
    assert main(["check", str(root), "-q", "--jobs", "1", "--no-graph", "--fail-on", "never"]) == 0
    assert main(["report", str(root), "-o", str(out), *more]) == 0
    folder = out / "computation"
    reported = capsys.readouterr().err
    return {path.name: json.loads(path.read_text()) for path in sorted(folder.glob("*.json"))}, reported


def test_first_launch_files_have_pages_with_findings(talking, tmp_path, capsys):
    found, reported = pages(talking, tmp_path / "out", capsys)
    assert list(found) == ["fleet.launch.xml.json"]
    assert [one["rule"] for one in found["fleet.launch.xml.json"]["findings"]] == ["graph.qos"]
    assert "roslens:" not in reported
    node = (tmp_path / "out/nodes/fleet.launch.xml/listener.html").read_text()
    assert "talk/talk/nodes.py.html#L16" in node.replace("../", "")


def test_declared_ones_have_pages_under_their_names(talking, tmp_path, capsys):
    (talking / "roslens.toml").write_text(
        '[graph.configurations.quiet]\nlaunch = "talk/robot.launch.xml"\narguments = { listening = false }\n'
        '[graph.configurations.lost]\nlaunch = "talk/no.launch.xml"\n'
    )
    found, reported = pages(talking, tmp_path / "out", capsys)
    assert [[one["name"] for one in page["elements"] if one["kind"] == "node"] for page in found.values()] == [
        ["/talker"]
    ]
    assert list(found) == ["quiet.json"]
    assert 'no launch file "talk/no.launch.xml"' in reported


def test_of_many_the_largest_are_shown_and_it_is_told(talking, tmp_path, capsys):
    for number in range(9):
        path = talking / f"talk/launch/more{number}.launch.xml"
        nodes = "".join(f'<node pkg="a{place}" exec="b"/>' for place in range(number + 1))
        path.write_text(f"<launch>{nodes}</launch>")
    found, reported = pages(talking, tmp_path / "out", capsys)
    assert len(found) == 8
    assert "more0.launch.xml.json" not in found
    assert "8 of 10 launch files" in reported


def test_they_can_be_left_out_and_a_workspace_that_is_gone_loses_only_them(talking, tmp_path, capsys):
    assert pages(talking, tmp_path / "out", capsys, "--no-graph")[0] == {}
    moved = tmp_path / "moved"
    shutil.move(talking, moved)
    assert main(["report", str(moved), "-o", str(tmp_path / "other"), "-q"]) == 0
    assert not (tmp_path / "other/computation").exists()


def test_a_run_shows_the_graphs_that_it_kept_whatever_became_of_its_files(talking, tmp_path, capsys):
    assert main(["check", str(talking), "-q", "--jobs", "1", "--graph", "--fail-on", "never"]) == 0
    nodes = talking / "talk/talk/nodes.py"
    nodes.write_text(nodes.read_text().replace('"chatter"', '"gossip"'))
    assert main(["check", str(talking), "-q", "--jobs", "1", "--graph", "--fail-on", "never"]) == 0
    for run, topic in (("1", "/chatter"), ("2", "/gossip")):
        assert main(["report", str(talking), "-o", str(tmp_path / run), "--run", run]) == 0
        page = json.loads((tmp_path / run / "computation/fleet.launch.xml.json").read_text())
        assert topic in [one["name"] for one in page["elements"]]
        assert page["note"] == ""
    assert [one["rule"] for one in page["findings"]] == ["graph.qos"]
    shutil.rmtree(talking / "talk")
    assert main(["report", str(talking), "-o", str(tmp_path / "gone"), "--run", "1"]) == 0
    assert (tmp_path / "gone/computation/fleet.launch.xml.html").exists()


def test_graphs_of_files_that_changed_since_the_run_say_so(talking, tmp_path, capsys):
    assert pages(talking, tmp_path / "a", capsys)[0]["fleet.launch.xml.json"]["note"] == ""
    (talking / "talk/launch/robot.launch.xml").write_text('<launch><node pkg="talk" exec="talker"/></launch>')
    (talking / "talk/launch/new.launch.xml").write_text("<launch/>")
    assert main(["report", str(talking), "-o", str(tmp_path / "b")]) == 0
    note = json.loads((tmp_path / "b/computation/fleet.launch.xml.json").read_text())["note"]
    assert "the files as they are now" in note
    assert "talk/launch/new.launch.xml and 1 more changed since" in note
    for page in ("computation/fleet.launch.xml", "nodes/fleet.launch.xml/talker"):
        assert "the files as they are now" in (tmp_path / f"b/{page}.html").read_text()


def test_of_many_that_were_kept_the_largest_are_shown(talking, tmp_path, capsys):
    for number in range(9):
        nodes = "".join(f'<node pkg="a{place}" exec="b"/>' for place in range(number + 1))
        (talking / f"talk/launch/more{number}.launch.xml").write_text(f"<launch>{nodes}</launch>")
    main(["check", str(talking), "-q", "--jobs", "1", "--graph", "all", "--fail-on", "never"])
    assert main(["report", str(talking), "-o", str(tmp_path / "out")]) == 0
    assert "8 of 10 launch files" in capsys.readouterr().err
    assert not (tmp_path / "out/computation/more0.launch.xml.json").exists()
    assert (tmp_path / "out/computation/more8.launch.xml.json").exists()


def without_graphs(root, tmp_path):
    """Return how many findings there are besides those of graphs."""
    out = tmp_path / "plain.json"
    words = ["check", str(root), "-q", "--jobs", "1", "--no-graph", "--no-store", "--fail-on", "never"]
    assert main([*words, "--format", "json", "-o", str(out)]) == 0
    return len(json.loads(out.read_text())["findings"])


def total(out):
    return json.loads((out / "overview.json").read_text())["counts"]["findings"]


def test_findings_that_a_run_did_not_look_for_are_told_apart_from_its_totals(talking, tmp_path, capsys):
    page = pages(talking, tmp_path / "apart", capsys)[0]["fleet.launch.xml.json"]
    assert (page["counted"], len(page["findings"])) == (False, 1)
    assert [row["rule"] for row in page["tables"]["findings"]["rows"]] == ["graph.qos"]
    text = (tmp_path / "apart/computation/fleet.launch.xml.html").read_text()
    assert "no total of these pages counts them" in text
    overview = (tmp_path / "apart/index.html").read_text()
    assert "This run did not check them" in overview
    assert "1 finding<" not in overview
    assert total(tmp_path / "apart") == without_graphs(talking, tmp_path)


def test_those_of_a_run_count_everywhere(talking, tmp_path):
    assert main(["check", str(talking), "-q", "--jobs", "1", "--graph", "--fail-on", "never"]) == 0
    assert main(["report", str(talking), "-o", str(tmp_path / "out"), "-q"]) == 0
    page = json.loads((tmp_path / "out/computation/fleet.launch.xml.json").read_text())
    assert (page["counted"], len(page["findings"])) == (True, 1)
    overview = (tmp_path / "out/index.html").read_text()
    assert "This run did not check them" not in overview
    assert "1 finding<" in overview
    assert total(tmp_path / "out") == without_graphs(talking, tmp_path) + 1
    rules = json.loads((tmp_path / "out/rules.json").read_text())["tables"]["rules"]["rows"]
    assert [row["findings"] for row in rules if row["rule"] == "graph.qos"] == [1]


def test_what_tells_most_is_shown_first(talking, tmp_path, capsys):
    (talking / "talk/launch/camera.launch.xml").write_text(
        '<launch><node pkg="talk" exec="talker" name="a$(var x)"/></launch>'
    )
    pages(talking, tmp_path / "out", capsys)
    overview = (tmp_path / "out/index.html").read_text()
    assert 0 < overview.index("fleet.launch.xml.html") < overview.index("camera.launch.xml.html")
