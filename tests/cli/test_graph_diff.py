"""``roslens graph --diff`` of revisions, launch files and documents, as a user meets it."""

import json
import os
import re
import subprocess

import pytest

from roslens.cli.main import main

LAUNCH = ("--launch", "talk/robot.launch.xml")


def git(root, *arguments):
    who = {f"GIT_{role}_{what}": "a@b.c" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    environment = {**os.environ, **who, "GIT_CONFIG_GLOBAL": "/dev/null"}
    subprocess.run(["git", "-C", str(root), "-c", "init.defaultBranch=main", *arguments], check=True, env=environment)


@pytest.fixture
def history(talking):
    """Return the workspace with a revision before, one after, and a change that is not in any."""
    git(talking, "init", "-q")
    git(talking, "add", ".")
    git(talking, "commit", "-qm", "before")
    git(talking, "tag", "before")
    nodes = talking / "talk/talk/nodes.py"
    nodes.write_text(nodes.read_text().replace("print, 10)", "print, qos_profile_sensor_data)"))
    git(talking, "commit", "-qam", "after")
    nodes.write_text(nodes.read_text().replace('"chatter"', '"gossip"'))
    (talking / "talk/launch/new.launch.xml").write_text('<launch><node pkg="talk" exec="talker"/></launch>')
    return talking


def compared(root, capsys, *arguments, code=1):
    assert main(["graph", str(root), "--jobs", "1", *arguments]) == code
    return capsys.readouterr()


def test_a_launch_file_at_two_revisions(history, capsys):
    text = compared(history, capsys, *LAUNCH, "--diff", "before", "HEAD").out
    assert text.splitlines()[0].startswith("--- talk/robot.launch.xml at before (")
    kind = "std_msgs/msg/String"
    assert text.splitlines()[2:4] == [
        "  /listener",
        f"~   subscription /chatter: {kind}, reliable, depth 10 -> {kind}, best_effort, depth 5",
    ]


def test_no_difference_is_exit_code_0(history, capsys):
    text = compared(history, capsys, *LAUNCH, "--arg", "listening:=false", "--diff", "before", "main", code=0).out
    assert text.endswith("no difference\n")


def test_a_revision_and_the_files_as_they_are(history, capsys):
    found = json.loads(compared(history, capsys, *LAUNCH, "--diff", "HEAD", ".", "--format", "json").out)
    assert found["schema"] == "roslens-graph-difference/1"
    assert found["before"].startswith("talk/robot.launch.xml at HEAD (")
    assert {(one["what"], one["name"], one["how"]) for one in found["differences"]} == {
        ("publisher", "/chatter", "removed"),
        ("publisher", "/gossip", "added"),
        ("subscription", "/chatter", "removed"),
        ("subscription", "/gossip", "added"),
    }


def test_without_a_launch_file_all_packages_are_compared(history, capsys):
    assert "~   subscription /chatter" in compared(history, capsys, "--diff", "before", "HEAD").out
    assert "+   publisher /gossip" in compared(history, capsys, "--package", "talk", "--diff", "HEAD", ".").out


def test_what_one_revision_lacks_is_new_on_the_other(history, capsys):
    reported = compared(history, capsys, "--launch", "talk/new.launch.xml", "--diff", "HEAD", ".")
    assert "+ /talker" in reported.out
    assert 'in "HEAD": no launch file "talk/new.launch.xml"' in reported.err
    reported = compared(history, capsys, "--launch", "talk/nw.launch.xml", "--diff", "HEAD", ".", code=2)
    assert 'Did you mean "talk/new.launch.xml"?' in reported.err


def test_the_workspace_itself_is_left_alone(history, capsys):
    before = {path: path.read_bytes() for path in history.rglob("*.py")}
    compared(history, capsys, *LAUNCH, "--diff", "before", "HEAD")
    compared(history, capsys, *LAUNCH, "--diff", "before", "HEAD")
    assert {path: path.read_bytes() for path in history.rglob("*.py")} == before
    assert "/gossip" in compared(history, capsys, *LAUNCH, code=0).out


def test_a_table_for_a_pull_request(history, capsys):
    table = compared(history, capsys, *LAUNCH, "--diff", "before", "HEAD", "--format", "markdown").out
    assert "| changed | `/listener` | subscription `/chatter` |" in table


def test_declared_configurations_are_named(history, capsys):
    (history / "roslens.toml").write_text(
        '[graph.configurations.quiet]\nlaunch = "talk/robot.launch.xml"\narguments = { listening = false }\n'
    )
    assert "- /listener" in compared(history, capsys, "--diff", "talk/robot.launch.xml", "quiet").out
    assert "no difference" in compared(history, capsys, "--launch", "quiet", "--diff", "before", "HEAD", code=0).out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--diff", "befor", "HEAD"], 'no revision "befor"'),
        (["--diff", "befor", "HEAD"], "Did you mean before?"),
        (["--diff", "before", "HEAD~9"], "`git fetch`"),
        (["--diff", "talk/robot.launch.xml", "HEAD"], "--launch talk/robot.launch.xml --diff A B"),
        (["--diff", "a.json", "HEAD"], "two files written by --format json"),
        (["--diff", "before", "HEAD", "--arg", "a:=b"], "--launch FILE too"),
        (["--diff", "before", "HEAD", "--format", "dot"], "text, markdown or json"),
        (["--diff", "before", "HEAD", "--node", "lisener"], 'Did you mean "/listener"?'),
    ],
)
def test_what_cannot_be_compared_is_told(history, capsys, arguments, message):
    assert message in compared(history, capsys, *arguments, code=2).err


def test_outside_of_a_repository(talking, capsys, monkeypatch):
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(talking.parent))
    assert "no git repository" in compared(talking, capsys, "--diff", "a", "b", code=2).err


def test_findings_that_are_new_and_gone(history, capsys):
    text = compared(history, capsys, *LAUNCH, "--diff", "before", "HEAD").out
    assert "findings: 1 gone" in text
    assert re.search(r"^- talk/talk/nodes.py:16: error: .*best_effort.* \[graph.qos\]$", text, re.MULTILINE)
    text = compared(history, capsys, *LAUNCH, "--diff", "HEAD", "before").out
    assert "findings: 1 new" in text


def test_findings_in_a_table_and_in_json(history, capsys):
    table = compared(history, capsys, *LAUNCH, "--diff", "before", "HEAD", "--format", "markdown").out
    assert "1 changed; findings: 1 gone" in table.splitlines()[0]
    assert "| gone | error | `graph.qos` | `talk/talk/nodes.py:16` |" in table
    found = json.loads(compared(history, capsys, *LAUNCH, "--diff", "before", "HEAD", "--format", "json").out)
    assert [one["rule"] for one in found["findings"]["gone"]] == ["graph.qos"]
    assert found["findings"]["new"] == []


def test_findings_of_two_sets_of_arguments(history, capsys):
    git(history, "checkout", "-q", "before", "--", ".")
    robot = "talk/robot.launch.xml"
    text = compared(history, capsys, "--diff", robot, f"{robot}:listening=false").out
    assert "findings: 1 gone" in text
    assert "[graph.qos]" in text


def test_findings_alone_are_a_difference(history, capsys):
    nodes = history / "talk/talk/nodes.py"
    git(history, "checkout", "-q", "before", "--", ".")
    nodes.write_text(nodes.read_text().replace("print, 10)", "print, 10)  # roslens: ignore[graph.qos]"))
    text = compared(history, capsys, *LAUNCH, "--diff", "before", ".").out
    assert "no difference in the graph\nfindings: 1 gone" in text


def test_findings_are_about_the_nodes_that_are_asked_for(history, capsys):
    text = compared(history, capsys, *LAUNCH, "--node", "listener", "--diff", "before", "HEAD").out
    assert "[graph.qos]" in text


def test_documents_say_that_findings_are_not_compared(history, capsys):
    for name, arguments in (("a.json", ()), ("b.json", ("--arg", "listening:=false"))):
        main(["graph", str(history), *LAUNCH, *arguments, "--format", "json", "-o", str(history / name)])
    documents = (str(history / "a.json"), str(history / "b.json"))
    reported = compared(history, capsys, "--diff", *documents, "--format", "json")
    assert json.loads(reported.out)["findings"] is None
    assert "findings are not compared" in reported.err


def test_a_submodule_that_is_missing_is_told(history, capsys):
    commit = "1234567890" * 4
    git(history, "update-index", "--add", "--cacheinfo", f"160000,{commit},vendor/driver")
    git(history, "commit", "-qm", "driver")
    reported = compared(history, capsys, *LAUNCH, "--diff", "before", "HEAD").err
    assert 'submodule vendor/driver of "HEAD" is missing' in reported
    assert "git -C vendor/driver fetch origin 1234567890" in reported
    assert '"before"' not in reported


def test_a_finding_in_a_file_of_another_name_has_moved(history, capsys):
    nodes = history / "talk/talk/nodes.py"
    nodes.write_text(nodes.read_text().replace('"gossip"', '"/gossip"'))
    git(history, "commit", "-qam", "a global name")
    said = compared(history, capsys, "--diff", "HEAD~1", "HEAD").out
    assert "[graph.global_name]" in said
    git(history, "mv", "talk/talk/nodes.py", "talk/talk/knots.py")
    setup = history / "talk/setup.py"
    setup.write_text(setup.read_text().replace("talk.nodes", "talk.knots"))
    git(history, "commit", "-qam", "another name of the file")
    text = compared(history, capsys, "--diff", "HEAD~1", "HEAD", code=0).out
    assert "no difference" in text
    assert "= talk/talk/nodes.py:" in text
    found = json.loads(compared(history, capsys, "--diff", "HEAD~1", "HEAD", "--format", "json", code=0).out)
    assert found["findings"]["moved"][0]["after"]["path"] == "talk/talk/knots.py"


@pytest.mark.parametrize("sign", ["=", ":="])
def test_arguments_of_a_launch_file_have_either_sign(history, capsys, sign):
    launch = "talk/robot.launch.xml"
    assert "- /listener" in compared(history, capsys, "--diff", launch, f"{launch}:listening{sign}false").out
