"""Process metrics by the command line: asked for, kept, reported, and what cannot be determined."""

import json

import pytest
from process_metrics.small_repository import SmallRepository, small_repository

from roslens.cli.main import main
from roslens.cli.workplace.process_option import seconds_of
from roslens.model.errors import UsageError


@pytest.fixture(scope="module")
def small(tmp_path_factory) -> SmallRepository:
    return small_repository(tmp_path_factory.mktemp("small") / "repository")


def report(folder, capsys, *options: str) -> tuple[int, dict]:
    code = main(["check", str(folder), "--format", "json", "-q", "--jobs", "1", "--fail-on", "never", *options])
    return code, json.loads(capsys.readouterr().out)


def values(found: dict, entity: str) -> dict[str, float]:
    return {one["quantity"]: one["value"] for one in found["measurements"] if one["entity"] == entity}


def test_asked_for_by_option_or_configuration(small, capsys):
    code, without = report(small.root, capsys)
    assert code == 0
    assert "process" not in without
    assert "revisions" not in values(without, "package:outer")
    code, found = report(small.root, capsys, "--process-metrics")
    assert code == 0
    assert found["process"][0]["metrics"]["revisions"] == 14
    assert values(found, "package:outer")["revisions"] == 12
    a = values(found, "file:outer/src/a.cpp")
    assert a["hotspot"] == a["churn"] * 10  # the complexity of its only function
    assert "hotspot" in {one["key"] for one in found["quantities"]}
    (small.root / "roslens.toml").write_text("[process]\nmetrics = true\nas_of = '2030-01-01'\n")
    _, configured = report(small.root, capsys)
    (small.root / "roslens.toml").unlink()
    assert configured["process"][0]["metrics"]["age"] > found["process"][0]["metrics"]["age"]


def test_the_same_run_stands_until_history_changes(tmp_path, capsys):
    made = small_repository(tmp_path / "r")
    _, first = report(made.root, capsys, "--process-metrics")
    _, again = report(made.root, capsys, "--process-metrics")
    assert first == again
    made.git("tag", "v2.0.0")
    _, tagged = report(made.root, capsys, "--process-metrics")
    assert tagged["process"][0]["metrics"]["releases"] == 3


def test_a_shallow_clone_is_not_analysed_and_says_so(small, tmp_path, capsys):
    small.git("clone", "-q", "--depth=1", f"file://{small.root}", str(tmp_path / "clone"))
    code, found = report(tmp_path / "clone", capsys, "--process-metrics")
    assert code == 3
    (failure,) = found["failures"]
    assert (failure["tool"], failure["entity"]) == ("history", "repository:.")
    assert "git fetch --unshallow" in failure["advice"]
    assert report(tmp_path / "clone", capsys, "--process-metrics", "--accept-partial")[0] == 0


def test_dates():
    assert seconds_of("1970-01-02") == seconds_of("1970-01-02T01:00+01:00") == 86_400
    with pytest.raises(UsageError, match="as_of 'yesterday'"):
        seconds_of("yesterday")


def test_a_date_that_is_none(small, capsys):
    assert main(["check", str(small.root), "--as-of", "soon"]) == 2
    assert "expected a date" in capsys.readouterr().err


MODEL = """\
kind: quality model
name: team
constraints:
  - {kind: repository, quantity: bus_factor, minimum: 50, severity: error}
  - {kind: package, quantity: revisions, maximum: 11}
  - {kind: file, quantity: churn, maximum: 5}
"""


def test_a_model_bounds_what_history_says(tmp_path, capsys):
    made = small_repository(tmp_path / "r")
    (tmp_path / "team.yaml").write_text(MODEL)
    options = ("--model", str(tmp_path / "team.yaml"), "--no-cache")
    code, found = report(made.root, capsys, *options, "--process-metrics")
    assert code == 0
    broken = {one["entity"]: one for one in found["findings"] if one["rule"].startswith("team.")}
    assert broken["repository:."]["severity"] == "error"
    assert broken["package:outer"]["value"] == 12
    assert "package:inner" not in broken
    churned = values(found, "file:outer/src/a.cpp")["churn"]
    assert broken["file:outer/src/a.cpp"]["value"] == churned > 5
    # Without a history nothing of it was judged, which is reported and no clean run.
    code, without = report(made.root, capsys, *options)
    assert code == 3
    assert [one["what"] for one in without["failures"]] == [
        "bounds on bus_factor, churn, revisions were not judged (quality model team)"
    ]
