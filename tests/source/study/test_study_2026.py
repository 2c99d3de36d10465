"""The study of today: what a list names and is not there, is another or too old, is left out and said."""

import importlib
import sys
from pathlib import Path

import pytest
from process_metrics.small_repository import SmallRepository

from roslens.model.finding import Severity
from roslens.model.result import PackageSummary, RuleCount
from roslens.model.study import Corpus, Subject

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"
NAMES = ("study_2015", "study_2026", "study_2026_tables", "study_2026_today")


@pytest.fixture
def study(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    yield importlib.import_module("study_2026")
    for name in NAMES:
        sys.modules.pop(name, None)


def test_repositories_that_are_not_there_or_others_are_left_out(study, tmp_path):
    made = SmallRepository(tmp_path / "ros2" / "arm")
    commit = made.commit("first", day=0, a_DOT_cpp="int a;\n")
    wanted = {"arm": {"version": commit}, "base": {"version": commit}}
    found, left_out = study.repositories_of(tmp_path, wanted, "")
    assert {name: dict(one.values) for name, one in found.items()} == {"arm": {"revisions": 1, "contributors": 1}}
    assert left_out == {"base": "it could not be fetched"}

    made.commit("second", day=1)
    found, left_out = study.repositories_of(tmp_path, {"arm": {"version": commit}}, "")
    assert not found
    assert left_out["arm"].endswith(f"not at {commit[:12]}")


def test_a_commit_of_before_the_first_day_is_too_old(study, tmp_path):
    made = SmallRepository(tmp_path / "ros1" / "arm")
    wanted = {"arm": {"version": made.commit("first", day=0, a_DOT_cpp="int a;\n")}}
    assert study.repositories_of(tmp_path, wanted, "2022-01-01") == ({}, {"arm": "its commit is of 2020-09-13"})


def test_the_page_counts_what_is_left_out(study):
    without = {"ros2": study.LeftOut({"base": "it could not be fetched"}, ("arm", "leg"))}
    assert study.absent(without) == [
        "- ROS 2: 1 repository of the list.",
        "  - `base`: it could not be fetched.",
        "  - 2 packages have no values, since cccc has none of a file: `arm`, `leg`.",
    ]


def test_findings_of_today_are_those_of_the_packages_that_the_tables_are_about(study):
    today = sys.modules["study_2026_today"]
    corpus = Corpus("runs", (), (), (Subject("arm", "robot"),))
    rules = (
        RuleCount("cpp.override", Severity.WARNING, 5, gated=3),
        RuleCount("ros.cbo.max", Severity.WARNING, 9, gated=9, tags=("metrics",)),
    )
    values = {"loc": 1500.0, "comment_ratio": 50.0}
    summaries = [
        PackageSummary("arm", "arm", "robot/arm", repository="robot", values=values, rules=rules),
        PackageSummary("arm", "arm", "other/arm", repository="other", values=values, rules=rules),
    ]
    found = today.today_of(corpus, summaries)
    assert (found.lines, dict(found.findings), dict(found.packages)) == (1500, {"cpp.override": 3}, {"cpp.override": 1})
    assert found.corpus.packages[0].values == {"loc": 1500, "comment_ratio": 0.5}
    rows = today.coding({"ros2": found}, {"ros2": "ROS 2"})
    assert rows[2:] == ["| `cpp.override` | 3 (2.00; 100 %) |", "| all that are on by default | 3 (2.00) |"]
