"""Summaries of packages."""

from roslens.model.finding import MOST_EXCESS, Finding, Severity
from roslens.model.result import PackageResult, RuleCount
from roslens.model.source import Location, Package
from roslens.store.summary import rule_counts, summarise


def test_the_small_run(sample):
    drive = summarise(sample.drive())
    assert drive.id == drive.name == "drive"
    assert drive.description == "Turns velocities into wheel speeds."
    assert drive.dependencies == ("arm", "roscpp")
    assert drive.values == {"loc": 52, "cyclomatic_complexity": 8.75}
    assert (drive.files, drive.classes, drive.functions, drive.failures) == (3, 1, 1, 1)
    assert drive.languages == {"cpp": 2, "manifest": 1}
    assert drive.roles == {"own": 2, "test": 1}
    assert drive.rules == (
        RuleCount(
            "ros.cyclomatic_complexity",
            Severity.WARNING,
            1,
            1,
            "cyclomatic complexity 17, at most 15 allowed, src/drive/src/drive.cpp:12",
            ("complexity", "metrics", "ros"),
            1.133333,
            path="src/drive/src/drive.cpp",
            line=12,
        ),
        RuleCount(
            "style.tabs",
            Severity.NOTE,
            1,
            0,
            'src/drive/test/test_drive.cpp:3: a tab, "quoted"',
            ("style",),
            path="src/drive/test/test_drive.cpp",
            line=3,
        ),
    )


def test_a_package_without_anything():
    empty = summarise(PackageResult(Package("a", "a", ".", Location("package.xml"))))
    assert (empty.values, empty.rules, empty.files, empty.languages) == ({}, (), 0, {})


def test_counts_go_by_rule_severity_and_tags_most_severe_and_frequent_first():
    def finding(rule, severity, tags, line, gated=True):
        return Finding(rule, severity, "m", "p", line, tags=tags, gated=gated)

    result = PackageResult(
        Package("a", "a", ".", Location("package.xml")),
        findings=(
            finding("r", Severity.NOTE, ("x",), 1),
            finding("r", Severity.NOTE, ("x",), 2),
            finding("r", Severity.NOTE, ("y",), 3),
            finding("s", Severity.ERROR, (), 4, gated=False),
            finding("s", Severity.ERROR, (), 5),
            finding("s", Severity.ERROR, (), 6),
            finding("t", Severity.ERROR, (), 7, gated=False),
        ),
    )
    counts = [(count.rule, count.tags, count.count, count.gated, count.example) for count in summarise(result).rules]
    assert counts == [
        ("s", (), 3, 2, "p:5: m"),
        ("t", (), 1, 0, "p:7: m"),
        ("r", ("x",), 2, 2, "p:1: m"),
        ("r", ("y",), 1, 1, "p:3: m"),
    ]


def test_the_example_is_the_worst_that_counts_with_its_place_last():
    def finding(value, line, gated=True, bound=5.0):
        entity = f"function:p.cpp#ns::f{line}(const std::string &)"
        return Finding(
            "r",
            Severity.NOTE,
            f"{value} x",
            "p.cpp",
            line,
            entity=entity,
            value=value,
            bound=bound,
            gated=gated,
            quantity="q",
        )

    (one,) = rule_counts([finding(6, 1), finding(30, 2), finding(90, 3, gated=False), finding(30, 4)])
    assert one.example == "30 x, p.cpp:2"
    (low,) = rule_counts([finding(4, 1), finding(0, 2), finding(2.5, 3)])
    assert low.example == "0 x, p.cpp:2"
    of_file = Finding("r", Severity.NOTE, "12.34 of p.cpp", "p.cpp", entity="file:p.cpp", value=12.34, bound=20)
    assert rule_counts([of_file])[0].example == "12.34 of p.cpp"


def test_an_infinite_excess_is_a_number():
    (one,) = rule_counts([Finding("r", Severity.NOTE, "m", "p", value=float("inf"), bound=5.0)])
    assert one.excess == MOST_EXCESS
    (one,) = rule_counts([Finding("r", Severity.NOTE, "m", "p", value=float("nan"), bound=5.0)])
    assert one.excess == 0.0
