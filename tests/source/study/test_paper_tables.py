"""The raw data of the 2016 study gives what the paper printed."""

from pathlib import Path

import pytest

from roslens.model.errors import UsageError
from roslens.report.study.study_tables import tables_of
from roslens.source.study.csv_rows import read_csv
from roslens.source.study.paper_tables import corpus_of
from roslens.source.study.study import study_of

FIXTURES = Path(__file__).parents[2] / "fixtures" / "study"

TABLE_II = {
    "Role": "1 0.71 1 3",
    "LOC": "461 3,779.17 20 36,353",
    "LOCom": "270.50 1,322.57 0 14,503",
    "%Com": "0.52 0.53 0 3.85",
    "CC": "3.92 5.03 0 47.48",
    "MI": "73.13 17.58 0 99.97",
    "CBO": "1.70 0.60 0 3.20",
    "WMC": "4.67 3.76 1 28.36",
    "MAC": "2 2.66 0 21.20",
    "#Dep": "1 5.94 0 41",
    "#RQV": "3 26.80 0 333",
    "#RCV": "387 5,384.63 10 61,712",
    "#Rev": "292 572.71 16 2,706",
    "#DC": "9 10.03 1 49",
    "#OI": "6 9.93 0 41",
    "#CI": "50 91.67 1 343",
}
"""Median, sample standard deviation, least and largest value, as printed."""


@pytest.fixture(scope="module")
def study():
    packages = read_csv(FIXTURES / "package_repo_metrics.csv")
    rules = read_csv(FIXTURES / "package_compliance.csv")
    return study_of(corpus_of(packages, [rules]), "role")


def test_all_64_cells_of_table_ii(study):
    (table,) = (one for one in tables_of(study) if one.key == "figures")
    columns = [table.head.index(name) for name in ("median", "SD", "min", "max")]
    printed = {row[0]: " ".join(row[place] for place in columns) for row in table.rows}
    assert printed == TABLE_II


def test_process_rows_are_over_repositories_and_others_over_packages(study):
    assert {one.n for one in study.figures} == {180, 45}
    assert [one.key for one in study.figures if one.n == 45] == [
        "revisions", "contributors", "open_issues", "closed_issues",
    ]  # fmt: skip


def test_thresholds_are_those_of_the_paper(study):
    printed = {study.column(one.key).title: study.column(one.key).threshold for one in study.figures}
    assert {title: text for title, text in printed.items() if text} == {
        "%Com": "> 0.2", "CC": "1..15", "MI": "0..100", "CBO": "0..5", "WMC": "1..100", "MAC": "1..20",
    }  # fmt: skip


def test_findings_divide_among_rules_as_in_the_paper(study):
    assert [(one.rule, one.count, one.packages) for one in study.rules] == [
        ("MIN_COM_RATIO", 639, 91),
        ("MAX_COUPLING", 470, 124),
        ("MAX_CC", 318, 81),
        ("MAX_AVAILABLE_METHODS", 12, 8),
        ("MAX_WEIGHT_METHODS", 4, 2),
        ("MAX_CHILDREN", 2, 1),
    ]
    by_rule = {one.rule: one.by_role for one in study.rules}
    assert by_rule["MIN_COM_RATIO"]["library"] == 495
    assert by_rule["MAX_COUPLING"] == {"driver": 318, "library": 118, "application": 34}
    assert by_rule["MAX_CC"] == {"driver": 165, "library": 128, "application": 25}


@pytest.mark.parametrize(
    ("one", "other", "value"),
    [
        ("loc", "rcv", 0.91), ("comment_lines", "rqv", 0.91), ("rqv", "rcv", 0.91), ("loc", "comment_lines", 0.79),
        ("wmc", "mac", 0.65), ("comment_ratio", "maintainability_index", 0.54),
        ("cyclomatic_complexity", "maintainability_index", -0.49), ("comment_ratio", "cbo", -0.39),
    ],
)  # fmt: skip
def test_correlations(study, one, other, value):
    (pair,) = (found for found in study.correlations if {found.one, found.other} == {one, other})
    assert round(pair.pearson.value, 2) == value
    assert pair.pearson.low < value < pair.pearson.high


def test_sentences_that_the_data_contradicts_are_told(study):
    held = {one.says: (one.holds, one.found) for one in study.statements}
    assert held["Findings of MAC are below a dozen."] == (False, "12 in 8 packages")
    assert held["Findings of WMC are below a dozen."][0]
    assert held["How many packages and repositories are looked at."][1] == "180 packages with code in 45 repositories"
    assert held["How much code there is in all."][1] == "261,747 lines of code, 109,344 of comments"
    assert held["How often rules are broken in all."][1].endswith("287,017 of all other rules, 288,462 together")
    assert held["Which coding rules are broken most."] == (None, "no table of coding rules was given")
    wrong = [found for holds, found in held.values() if holds is False]
    assert wrong[1] == "30 packages, 24 of them with fewer, 6 with 332 to 1,841"
    assert wrong[2].startswith("8 of 55 pairs have |r| of 0.5 or more: LOC and #RCV 0.91")
    assert len(wrong) == 3


def test_role_medians(study):
    medians = {one.group: one.median for one in study.groups if one.key == "loc"}
    assert medians == {"application": 369, "driver": 731, "library": 401.5}


def test_without_rules_nothing_is_claimed_of_them():
    found = study_of(corpus_of(read_csv(FIXTURES / "package_repo_metrics.csv")))
    assert [one.holds for one in found.statements if "no table of rules" in one.found] == [None] * 6
    assert not found.rules


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("turtlebot_teleop,3", "turtlebot_teleop,7", r'2: the level "7"; expected 1 \(driver\)'),
        ("yocs_navigator,2", "turtlebot_teleop,2", '4: a second row of "turtlebot_teleop"'),
        ("yujin_ocs,9,342", "yujin_ocs,10,342", '4: "yujin_ocs" has other figures'),
        (",65,28,", ",many,28,", '2: "many" in the column "Cpp LoC"'),
    ],
)
def test_rows_that_cannot_be_are_refused_with_their_line(tmp_path, old, new, message):
    text = (FIXTURES / "package_repo_metrics.csv").read_text()
    path = tmp_path / "changed.csv"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(UsageError, match=message):
        corpus_of(read_csv(path))
