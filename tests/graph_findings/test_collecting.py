"""Clones are found, and the command line is asked about what is committed in them."""

import subprocess

import pytest

from graph_findings import collecting
from graph_findings.__main__ import main
from graph_findings.collecting import NotReadError, findings_of
from graph_findings.judgements import read
from graph_findings.repositories import Repository, repositories

LAUNCH = '<launch><node pkg="talk" exec="talkr" name="talker"/></launch>\n'
FILES = {
    "package.xml": '<package format="3"><name>talk</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>MIT</license>'
    "<export><build_type>ament_python</build_type></export></package>",
    "setup.py": "from setuptools import setup\nsetup(name='talk', packages=['talk'], entry_points={'console_scripts': "
    "['talker = talk.nodes:talk']})\n",
    "setup.cfg": "[install]\ninstall_scripts=$base/lib/talk\n",
    "talk/nodes.py": "import rclpy\n\n\ndef talk():\n    rclpy.spin(rclpy.create_node('talker'))\n",
    "launch/talk.launch.xml": LAUNCH,
}


def git(root, *words):
    who = ["-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "init.defaultBranch=main"]
    subprocess.run(["git", "-C", str(root), *who, *words], check=True, capture_output=True)


@pytest.fixture
def clones(tmp_path):
    root = tmp_path / "clones" / "owner+talk"
    for path, text in FILES.items():
        place = root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    git(root, "init", "-q")
    git(root, "add", "-A")
    git(root, "commit", "-qm", "one")
    other = tmp_path / "clones" / "other" / "bare"
    other.mkdir(parents=True)
    git(other, "clone", "-q", "--bare", str(root), ".")
    (tmp_path / "clones" / "no_clone").mkdir()
    return tmp_path / "clones"


def test_repositories_below_a_folder(clones):
    found = list(repositories(clones))
    assert [one.name for one in found] == ["other/bare", "owner/talk"]
    assert len({one.commit for one in found}) == 1


def test_findings_are_those_of_the_commit(clones):
    (clones / "owner+talk/launch/talk.launch.xml").write_text("<launch/>")
    for one in repositories(clones):
        (finding,) = [each for each in findings_of(one) if each["severity"] == "error"]
        assert (finding["rule"], finding["path"]) == ("graph.executable", "launch/talk.launch.xml")
        assert "did you mean `talker`?" in finding["message"]


def test_what_takes_too_long_is_told(clones, monkeypatch):
    monkeypatch.setattr(collecting, "TIME_LIMIT_S", 0.01)
    with pytest.raises(NotReadError, match=r"roslens check took more than 0\.01 s"):
        findings_of(next(repositories(clones)))


def test_a_clone_without_its_commit_is_told(clones):
    one = next(repositories(clones))
    with pytest.raises(NotReadError, match="has no commit"):
        findings_of(Repository(one.name, one.clone, "0" * 40))


def test_a_sample_is_written(clones, monkeypatch, capsys):
    out = clones / "s.yaml"
    monkeypatch.setattr("sys.argv", ["x", "sample", str(clones), "--seed", "3", "--per-rule", "1", "-o", str(out)])
    assert main() == 0
    sample = read(out)
    assert sample.population == {"graph.executable": 2}
    assert [(one.rule, one.severity, one.verdict) for one in sample.findings] == [("graph.executable", "error", None)]
    assert "owner/talk: " in capsys.readouterr().err
    (clones / "empty").mkdir()
    monkeypatch.setattr("sys.argv", ["x", "sample", str(clones / "empty"), "--seed", "3", "-o", str(out)])
    assert main() == 2
