"""What the tables say still holds: nothing that was told is silent now, and correct forms stay clean."""

import os
from pathlib import Path

import pytest

from reports.recorded import tables
from reports.report_case import ROUNDS, rebuilt
from reports.running import check
from reports.scoring import VERDICTS, score

CASES = [(name, one) for name in ROUNDS for one in rebuilt(name)]
SAMPLE = (
    "26-not-in-the-index",
    "30-one-colon-in-a-component",
    "35-clean-either-header",
    "37-clean-argument-to-be-given",
)


def holds(name, one):
    recorded = tables(name)[-1].by_name()[one.name]
    scored = score(one)
    assert len(scored.alarms) <= len(recorded.alarms), scored.alarms
    if recorded.verdict:
        assert VERDICTS.index(scored.verdict) <= VERDICTS.index(recorded.verdict), f"was: {recorded.by}"


@pytest.mark.parametrize(
    "one", [one for name, one in CASES if name == "first" and one.name in SAMPLE], ids=lambda one: one.name
)
def test_a_few_reports_are_told_as_recorded(one):
    holds("first", one)


@pytest.mark.nightly
@pytest.mark.parametrize(("name", "one"), CASES, ids=lambda one: getattr(one, "name", one))
def test_every_report_is_told_as_recorded(name, one):
    holds(name, one)


def test_a_run_leaves_no_trace(monkeypatch, tmp_path):
    monkeypatch.setenv("ROS_DISTRO", "humble")
    before = Path.cwd()
    (tmp_path / "package.xml").write_text("<package>")
    said = check(tmp_path)
    assert any("package.xml" in str(one) for one in [*said.findings, *said.failures])
    assert (Path.cwd(), os.environ["ROS_DISTRO"]) == (before, "humble")
    assert [path.name for path in tmp_path.iterdir()] == ["package.xml"]
