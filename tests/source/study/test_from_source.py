"""The comparison of the study from source with its raw data, on values made for it."""

import importlib.util
import sys
from pathlib import Path

import pytest

from roslens.model.finding import Severity
from roslens.model.result import PackageSummary, RuleCount

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def benchmark():
    spec = importlib.util.spec_from_file_location("study_2015_benchmark", ROOT / "benchmarks" / "study_2015.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


RAW = {
    "Package": "arm", "Cpp LoC": "100", "Cpp LoCom": "20", "CC": "3.33", "CBO": "1.66666666667", "WMC": "2.0",
    "MAC": "0", "NoC": "0", "DIT": "0", "Maintainability": "64.1812665366", "Metrics Violations": "2",
}  # fmt: skip
VALUES = {
    "loc": 100.0, "comment_lines": 20.0, "cyclomatic_complexity": 10 / 3, "cbo": 5 / 3, "wmc": 2.0, "mac": 0.0,
    "noc": 0.0, "dit": 0.0, "maintainability_index": 64.18126653661, "rqv": 2.0,
}  # fmt: skip


def found(**changed):
    return {"arm": {f"paper2016.{key}": value for key, value in {**VALUES, **changed}.items()}}


def test_equal_to_the_digits_that_the_raw_data_has(benchmark):
    equal, differing = benchmark.differences([RAW], found())
    assert set(equal.values()) == {1}
    assert not differing


@pytest.mark.parametrize(
    ("key", "value", "row"),
    [
        ("loc", 101.0, ("arm", "LOC", "100", "101")),
        ("cyclomatic_complexity", 3.34, ("arm", "CC", "3.33", "3.34")),
        ("cbo", 1.6667, ("arm", "CBO", "1.66666666667", "1.6667")),
        ("maintainability_index", 64.18, ("arm", "MI", "64.1812665366", "64.18")),
        ("rqv", 3.0, ("arm", "#RQV", "2", "3")),
    ],
)
def test_each_difference_is_told(benchmark, key, value, row):
    equal, differing = benchmark.differences([RAW], found(**{key: value}))
    assert differing == [row]
    assert equal[row[1]] == 0


def test_a_package_that_is_not_there_differs_in_everything(benchmark):
    equal, differing = benchmark.differences([RAW], {})
    assert set(equal.values()) == {0}
    assert {row[3] for row in differing} == {"not measured"}
    assert len(differing) == len(benchmark.COMPARED) == 10


def test_the_page_is_of_the_raw_data_that_is_here(benchmark):
    text = (ROOT / "docs" / "study.md").read_text()
    for name in (name for name, _, _ in benchmark.COMPARED.values()):
        assert f"| {name} | 180 of 180 |" in text
    assert "| #Rev | 45 of 45 repositories |" in text
    assert "\n## What differs\n\nNothing.\n" in text


def test_findings_of_a_rule_count_in_all_severities(benchmark):
    rules = (
        RuleCount("package.undeclared_dependency", Severity.WARNING, 2, gated=2),
        RuleCount("package.undeclared_dependency", Severity.ERROR, 3, gated=3),
        RuleCount("cpp.override", Severity.WARNING, 4),
        RuleCount("ros.cbo.max", Severity.WARNING, 9, gated=9, tags=("metrics",)),
    )
    found = benchmark.coding_findings(PackageSummary("arm", "arm", "arm", rules=rules))
    assert found == {"package.undeclared_dependency": 5}
