"""Forges by the command line: asked only with --forge, each failure of its repository alone."""

import json

import pytest
from process_metrics.local_forge import local_forge
from process_metrics.small_repository import MANIFEST, SmallRepository

from roslens.cli.main import main


@pytest.fixture
def forge():
    with local_forge() as made:
        yield made


@pytest.fixture
def made(tmp_path) -> SmallRepository:
    repository = SmallRepository(tmp_path / "r")
    repository.commit("one", day=0, package_DOT_xml=MANIFEST.format("p"))
    return repository


def report(folder, capsys, *options: str) -> tuple[int, dict]:
    words = ["check", str(folder), "--format", "json", "-q", "--jobs", "1", "--process-metrics", "--fail-on", "never"]
    code = main([*words, *options])
    return code, json.loads(capsys.readouterr().out)


def test_issues_are_measured_of_the_repository(made, forge, capsys, monkeypatch):
    monkeypatch.setenv("GITEA_TOKEN", "hunter2hunter2")
    made.git("remote", "add", "origin", "git@127.0.0.1:o/n.git")
    listed = "/api/v1/repos/o/n/issues?state={}&type={}&limit=50&page=1"
    numbers = {("open", "issues"): 3, ("closed", "issues"): 8, ("open", "pulls"): 1, ("closed", "pulls"): 5}
    for (state, what), number in numbers.items():
        forge.add(listed.format(state, what), [], x_total_count=str(number), etag=f'"{state}{what}"')
    code, without = report(made.root, capsys)
    assert (code, forge.asked) == (0, [])
    assert "open_issues" not in without["process"][0]["metrics"]
    host = ("--forge", "--forge-host", f"{forge.url}=gitea")
    code, found = report(made.root, capsys, *host)
    metrics = found["process"][0]["metrics"]
    assert code == 0
    keys = ("open_issues", "closed_issues", "open_requests", "closed_requests")
    assert [metrics[one] for one in keys] == [3, 8, 1, 5]
    asked = len(forge.asked)
    code, offline = report(made.root, capsys, *host, "--offline")
    assert offline["process"] == found["process"]
    assert len(forge.asked) == asked
    kept = b"".join(path.read_bytes() for path in (made.root / ".roslens").iterdir() if path.is_file())
    assert b"hunter2hunter2" not in kept


def test_a_forge_that_does_not_tell_is_a_failure_of_its_repository(made, forge, capsys):
    made.git("remote", "add", "origin", "https://user:password@127.0.0.1/o/n.git")
    code, found = report(made.root, capsys, "--forge", "--forge-host", f"{forge.url}=github")
    assert code == 3
    (failure,) = found["failures"]
    assert failure["tool"] == "forge"
    assert "404" in failure["what"]
    assert found["process"][0]["metrics"]["revisions"] == 1
    code, found = report(made.root, capsys, "--forge")
    assert "on no forge that is known" in found["failures"][0]["what"]
    assert "user:password" not in json.dumps(found)


def test_without_a_remote(made, capsys):
    code, found = report(made.root, capsys, "--forge")
    assert code == 3
    assert "no remote `origin`" in found["failures"][0]["what"]


def test_options_that_make_no_sense(made, capsys):
    assert main(["check", str(made.root), "--forge"]) == 2
    assert "--forge without process metrics" in capsys.readouterr().err
    assert main(["check", str(made.root), "--process-metrics", "--forge", "--forge-host", "x=cvs"]) == 2
    assert "expected HOST=KIND" in capsys.readouterr().err
