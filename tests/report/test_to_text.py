"""The text report: what matters most, fitted to the terminal, harmless, with what was left out."""

import re
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.result import PackageSummary, RuleCount, RunHeader
from roslens.model.source import Location
from roslens.model.tags import parse_tags
from roslens.report.run.to_text import to_text
from roslens.report.writing.terminal import columns

FIXTURES = Path(__file__).parents[1] / "fixtures" / "report"
HEADER = RunHeader(
    "key", "/home/me/robot_ws", models=("ros", "his"), commit="9ad644198e132d0950579a3bc72c29da46e60bb0+"
)
ERROR, WARNING, NOTE = Severity.ERROR, Severity.WARNING, Severity.NOTE
RULES = (
    RuleInfo("ros.cyclomatic_complexity.max", "Cyclomatic complexity above 15", ""),
    RuleInfo("manifest.missing_dependency", "A package is used but not declared", ""),
    RuleInfo("haros.cpplint.build_include_what_you_use", "Include what you use, " * 5, ""),
)
SGR = re.compile(r"\x1b\[[0-9;]+m")


def package(number, name, *rules, **values):
    metrics = {
        "loc": 100 * number,
        "cyclomatic_complexity.max": number % 30,
        "cognitive_complexity.max": number * 3 % 70,
        "nesting.max": number % 7,
        "cbo.max": number % 13,
        "comment_ratio": number * 1.7 % 60,
        "duplication_ratio": number * 0.3,
        "dependents": number % 5,
    }
    return PackageSummary(name, name, f"src/{name}", values={**metrics, **values}, rules=rules, files=number)


def complexity(count, gated, place):
    function = "drive::Drive::update(const std::shared_ptr<Message> &)"
    text = f"{place}: cyclomatic complexity of {function} is 31; at most 15 (ros)"
    return RuleCount(
        "ros.cyclomatic_complexity.max", WARNING, count, gated, text, ("metrics", "ros", "complexity"), 20.0
    )


def missing(count, place):
    example = f"{place}: tf2 is used but not declared"
    return RuleCount("manifest.missing_dependency", ERROR, count, count, example, ("dependencies",))


def include(count, gated=None):
    rule = "haros.cpplint.build_include_what_you_use"
    return RuleCount(rule, NOTE, count, count if gated is None else gated, "a.cpp:1: add #include <map>", ("style",))


PACKAGES = (
    package(3, "arm"),
    package(41, "drive", complexity(30, 20, "src/drive/src/drive.cpp:12"), include(1400)),
    package(25, "nav2_regulated_pure_pursuit_controller_plugins", missing(1, "src/nav2/package.xml:9")),
    package(17, "vision", missing(2, "src/vision/package.xml:4"), complexity(5, 5, "src/vision/a.cpp:7")),
    package(9, "only_tests", include(7, 0)),
    PackageSummary("meta", "meta", "src/meta"),
    *(package(number, f"part_{number:02d}") for number in range(50, 62)),
)
FAILURES = (
    Failure(
        "syntax",
        "cannot parse `PLUGINLIB_EXPORT_CLASS(a, b)`",
        "cpp source",
        "Name the macro under [macros] in roslens.toml",
        Location("src/drive/src/drive.cpp", 44, 1),
        partial=True,
    ),
    *(
        Failure(
            "syntax",
            f"cannot parse `X{number}`",
            "cpp source",
            "Name the macro under [macros] in roslens.toml",
            Location("src/vision/a.cpp", number, 1),
            partial=True,
        )
        for number in range(1, 6)
    ),
    Failure(
        "workspace",
        "'pakage' is no tag of a manifest",
        "a package.xml",
        "Repair it",
        Location("src/bad/package.xml", 2, 3),
    ),
)


def text(width=100, *, packages=PACKAGES, failures=FAILURES, header=HEADER, rules=RULES, **options):
    return to_text(header, packages, failures, rules, width=width, **options)


@pytest.mark.parametrize("width", [60, 80, 120, 200])
def test_it_looks_as_it_was_found_good(width):
    assert text(width) == (FIXTURES / f"text_{width}.txt").read_text("utf-8")


def test_it_looks_as_it_was_found_good_in_ascii_and_in_colour():
    assert text(80, unicode=False) == (FIXTURES / "text_ascii.txt").read_text("ascii")
    assert text(80, color=True) == (FIXTURES / "text_colour.txt").read_text("utf-8")


def test_colour_adds_nothing_but_colour():
    assert SGR.sub("", text(color=True)) == text()
    assert not SGR.search(text())


def test_severities_have_a_sign_and_a_word():
    shown = text()
    for word in ("✖ error", "▲ warning", "✖ failed", "◐ partly"):
        assert word in shown
    assert "● note" in text(packages=[package(1, "arm", include(3))])


def test_notes_are_one_line_beside_what_is_more_severe():
    shown = text()
    assert "1,400 notes of 1 rule, most of haros.cpplint.build_include_what_you_use (1,400). All: " in shown
    assert "● note" not in shown


def test_what_to_fix_first_is_said_first():
    shown = text()
    assert shown.index("Fix first") < shown.index("  package ")
    assert "  1. ✖ src/vision/package.xml:4: tf2 is used but not declared\n" in shown


def test_only_what_counts_is_counted():
    shown = text()
    assert "Findings: 3 errors, 25 warnings, 1,400 notes\n" in shown
    assert "17 more findings in test, generated or vendored code do not count here\n" in shown
    assert re.search(r"^  only_tests +· +· +· ", shown, re.MULTILINE)


def test_copies_of_other_projects_are_named():
    copied = msgspec.structs.replace(package(1, "usb_cam"), copy_of="ros-drivers/usb_cam 0.3.6")
    shown = to_text(HEADER, [copied, package(2, "robot")], [], RULES, width=200)
    assert "1 package is a copy of another project, and counts as vendored code: usb_cam. To count as own" in shown
    assert 'own = ["src/usb_cam/**"] below [workspace] in roslens.toml' in shown
    many = [msgspec.structs.replace(copied, id=f"p{number}", name=f"p{number}") for number in range(7)]
    assert "7 packages are copies of other projects" in to_text(HEADER, many, [], RULES, width=200)
    assert "p4 and 2 more. " in to_text(HEADER, many, [], RULES, width=200)


def test_what_is_cut_is_said():
    shown = text()
    assert "15 of 18 packages, worst first; no finding in the others. All: roslens report\n" in shown
    rules = [RuleCount(f"a.rule_{number}", WARNING, 20 - number, 20 - number) for number in range(14)]
    shown = text(packages=[package(1, "arm", *rules)])
    assert "10 of 14 rules, worst first; 34 findings of the others. All: roslens report\n" in shown
    failures = [Failure("t", f"f{number}", advice=f"a{number % 8}") for number in range(20)]
    assert "4 more. All: roslens report\n" in text(failures=failures)


def limit(rule, excess, count=4):
    return RuleCount(rule, WARNING, count, count, f"{excess} x", ("metrics", "ros"), excess)


def test_limits_that_are_little_exceeded_are_a_line_where_there_are_mistakes():
    limits = [limit("ros.cbo.max", 8.6, 9), limit("ros.comment_ratio.min", 99.0), limit("ros.function_limits", 40.0)]
    shown = text(packages=[package(1, "arm", missing(3, "a.xml:2"), *limits)])
    findings = shown[shown.index("Findings: 3 errors, 17 warnings\n") :]
    assert "ros.function_limits" in findings
    assert "comment_ratio" not in findings
    assert (
        "  13 limits of metrics of 2 rules, none far exceeded, most of ros.cbo.max (9). All: roslens report\n" in shown
    )
    shown = text(packages=[package(1, "arm", *limits[:2])])
    assert "ros.cbo.max" in shown
    assert "limits of metrics of" not in shown


def test_what_is_surest_stands_first_among_rules_of_a_severity():
    unsure = RuleCount("package.b", WARNING, 90, 90, "b.xml:1: b", ())
    sure = RuleCount("package.a", WARNING, 1, 1, "a.xml:1: a", ())
    rules = (RuleInfo("package.a", "A", "", precision=0.98), RuleInfo("package.b", "B", "", precision=0.3))
    shown = to_text(HEADER, [package(1, "arm", unsure, sure)], [], rules)
    findings = shown[shown.index("Findings:") :]
    assert findings.index("package.a") < findings.index("package.b")


def test_failures_that_ask_for_the_same_stand_together():
    shown = text()
    assert "Not analysed: 1, 6 in part\n" in shown
    assert shown.count("Name the macro under [macros] in roslens.toml\n") == 1
    assert "and 3 more like it\n" in shown
    assert shown.index("'pakage' is no tag") < shown.index("PLUGINLIB_EXPORT_CLASS")


def test_the_worst_value_beyond_a_bound_is_marked():
    shown = text()
    assert re.search(r"^  vision .* 17▲ ", shown, re.MULTILINE)
    assert re.search(r"^  arm .* 3  ", shown, re.MULTILINE)
    assert "▲ beyond a bound of a quality model" in shown


def test_tags_choose_findings():
    shown = text(tags=parse_tags("dependencies or style"))
    assert "Findings with the tags dependencies or style: 3 errors, 1,400 notes\n" in shown
    assert "ros.cyclomatic_complexity" not in shown
    assert "No findings with the tags nonsense in what was analysed" in text(tags=parse_tags("nonsense"))


def test_findings_of_no_package_are_among_the_others():
    cycle = Finding("manifest.cycle", ERROR, "drive -> arm -> drive", entity="package:drive", tags=("dependencies",))
    shown = text(findings=[cycle, cycle])
    assert "Findings: 5 errors, 25 warnings" in shown
    assert re.search(r"✖ error +2  manifest.cycle", shown)
    assert "package:drive: drive -> arm -> drive" in shown
    assert "Findings: 3 errors" not in text(findings=[cycle], tags=parse_tags("style"))


def test_next_steps_fit_what_was_found():
    assert "roslens explain manifest.missing_dependency" in text()
    assert "roslens doctor" in text()
    clean = text(packages=PACKAGES[:1], failures=())
    assert "✔ No findings in what was analysed\n" in clean
    assert "roslens explain" not in clean
    assert "roslens doctor" not in clean
    assert "roslens serve" in clean


def test_nothing_found_is_not_clean():
    shown = text(packages=(), failures=())
    assert "No packages were found.\n" in shown
    assert "No findings" not in shown
    assert "roslens check PATH" in shown


def test_severities_that_do_not_occur_have_no_column():
    shown = text(packages=[package(1, "arm", complexity(1, 1, "a:1"))])
    assert re.search(r"^  package +warnings +lines", shown, re.MULTILINE)


def test_what_comes_from_source_does_nothing_to_the_terminal():
    bad = "evil\x1b[2J\x07\r\n\u202e\u2066name"
    count = RuleCount(bad, WARNING, 1, 1, bad)
    shown = text(
        packages=[package(1, bad, count)],
        failures=[Failure(bad, bad, bad, bad, Location(bad, 1))],
        header=msgspec.structs.replace(HEADER, root=f"/ws/{bad}", commit=bad, models=(bad,)),
        rules=[RuleInfo(bad, bad, bad)],
    )
    assert not re.search(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", shown)
    assert "evil\\x1b[2J\\x07" in shown


TEXTS = st.text(st.characters(), min_size=1, max_size=60)


@given(
    st.integers(40, 220), TEXTS, TEXTS, st.lists(st.tuples(TEXTS, st.sampled_from(Severity)), max_size=4), st.booleans()
)
def test_no_line_is_wider_than_the_terminal(width, name, message, found, unicode):
    rules = [RuleCount(rule, severity, 1234, 1234, message) for rule, severity in found]
    shown = text(
        width,
        packages=[package(7, name, *rules)],
        failures=[Failure(name, message, message, message, Location(name, 3), partial=True)] * 5,
        rules=[RuleInfo(rule, message, "") for rule, _severity in found],
        header=msgspec.structs.replace(HEADER, root=f"/{name}", models=(message[:20],)),
        unicode=unicode,
    )
    commands = ("  roslens ",)
    wide = [line for line in shown.splitlines() if columns(line) > max(width, 60) and not line.startswith(commands)]
    assert wide == []
    assert unicode or shown.isascii()
