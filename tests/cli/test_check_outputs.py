"""Which formats ``roslens check`` writes, and where."""

import json

import pytest

from roslens.cli.check.check_outputs import below_repository, outputs
from roslens.cli.main import main
from roslens.model.errors import UsageError


@pytest.mark.parametrize(
    ("formats", "files", "expected"),
    [
        ([], [], [("text", "")]),
        (["json"], [], [("json", "")]),
        (["json"], ["out"], [("json", "out")]),
        ([], ["a.sarif", "b.md"], [("sarif", "a.sarif"), ("markdown", "b.md")]),
        (["junit=x.xml"], [], [("text", ""), ("junit", "x.xml")]),
        (["github", "sarif=x.json"], [], [("github", ""), ("sarif", "x.json")]),
        (["csv=tables"], ["r.txt"], [("text", "r.txt"), ("csv", "tables")]),
    ],
)
def test_where_each_goes(formats, files, expected):
    assert list(outputs(formats, files)) == expected


@pytest.mark.parametrize(
    ("formats", "files", "said"),
    [
        (["sarfi"], [], "Did you mean sarif?"),
        (["json", "sarif"], [], "only one goes to standard output"),
        (["json"], ["a", "b"], "--format json=FILE"),
        (["json="], [], "names no file"),
        ([], ["a.xml"], "--format junit=a.xml or --format checkstyle=a.xml"),
        ([], ["a.html"], "roslens report --single-file a.html"),
        ([], ["a.xyz"], "--format NAME=a.xyz"),
        (["junit=a", "sarif=a"], [], "is given for two results"),
    ],
)
def test_what_is_not_clear_is_refused(formats, files, said):
    with pytest.raises(UsageError, match=said.replace("?", r"\?")):
        outputs(formats, files)


def test_several_formats_of_one_run(talking, tmp_path, capsys):
    (talking / ".git").mkdir()
    (talking / "roslens.toml").write_text('[rules]\ndisable = ["*"]\n')
    words = ["check", str(talking / "talk"), "--jobs", "1", "-q", "--fail-on", "never", "--no-store", "--no-cache"]
    sarif, junit = tmp_path / "a.sarif", tmp_path / "junit.xml"
    assert main([*words, "--model", "his", "-o", str(sarif), "--format", f"junit={junit}"]) == 0
    assert capsys.readouterr().out == ""
    uris = {
        place["physicalLocation"]["artifactLocation"]["uri"]
        for result in json.loads(sarif.read_text())["runs"][0]["results"]
        for place in result["locations"]
    }
    assert uris == {"talk/setup.py", "talk/talk/nodes.py"}
    assert 'name="roslens.talk"' in junit.read_text()


def test_an_unclear_format_is_told_before_anything_is_analysed(talking, capsys):
    assert main(["check", str(talking), "-o", "x.xml"]) == 2
    assert "junit=x.xml" in capsys.readouterr().err
    assert not (talking / ".roslens").exists()


def test_the_folder_below_the_repository(tmp_path):
    inner = tmp_path / "repository/ws/src"
    inner.mkdir(parents=True)
    assert below_repository(inner) == ""
    (tmp_path / "repository/.git").mkdir()
    assert below_repository(inner) == "ws/src/"
    assert below_repository(tmp_path / "repository") == ""
