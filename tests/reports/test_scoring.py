"""A verdict is that of a finding at the place, about the right thing."""

import pytest

from reports.report_case import Place, Rebuilt, ReportCase
from reports.running import Failure, Finding, Said
from reports.scoring import fits, judge, of_metric, score

PLACE = Place(path="src/a/a.yaml", any=["Rate"], lines=(3, 7))


def finding(severity="warning", path="src/a/a.yaml", line=5, message="the rate is wrong", **more):
    return Finding(rule="yaml.value", severity=severity, message=message, path=path, line=line, **more)


@pytest.fixture
def workspace(tmp_path):
    (tmp_path / "src" / "a").mkdir(parents=True)
    for name in ("a.yaml", "b.yaml"):
        (tmp_path / "src" / "a" / name).write_text("")
    return tmp_path


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        (finding(), True),
        (finding(line=3), True),
        (finding(line=7), True),
        (finding(line=8), False),
        (finding(line=2), False),
        (finding(line=1, end_line=4), True),
        (finding(line=1, end_line=40), False),
        (finding(line=4, end_line=40), True),
        (finding(line=0), False),
        (finding(path="src/a/b.yaml"), False),
        (finding(path="./src/a/a.yaml"), True),
        (finding(message="the speed is wrong"), False),
        (finding(path="/opt/ros/node.yaml", message="rate: src/a/a.yaml:6 gives it"), True),
        (finding(path="/opt/ros/node.yaml", message="rate: src/a/a.yaml:9 gives it"), False),
    ],
)
def test_a_finding_fits_where_it_stands_at_the_place_and_speaks_of_it(workspace, found, expected):
    assert fits(found, PLACE, workspace) is expected


def test_a_place_without_lines_is_the_whole_file(workspace):
    assert fits(finding(line=900), Place(path="src/a/a.yaml", any=["rate"]), workspace)
    assert fits(finding(line=0), Place(path="src/a/a.yaml", any=["rate"]), workspace)


@pytest.mark.parametrize(
    ("findings", "failures", "expected"),
    [
        ([finding("note"), finding("warning"), finding("error")], [], "told"),
        ([finding("note")], [], "note"),
        ([finding("error", line=90), finding("note")], [], "note"),
        ([finding("error", quantity="eloc")], [], "silent"),
        ([finding(line=90)], [Failure(what="rate has no value", path="src/a/a.yaml", line=5)], "failure"),
        ([], [Failure(what="rate has no value", path="src/a/b.yaml")], "silent"),
        ([], [Failure(what="no such node", path="src/a/a.yaml")], "silent"),
        ([], [], "silent"),
    ],
)
def test_the_verdict_is_the_best_of_what_fits(workspace, findings, failures, expected):
    verdict, by = judge([PLACE], Said(findings, failures), workspace)
    assert verdict == expected
    assert bool(by) == (expected != "silent")


def test_limits_of_metrics_are_known():
    assert of_metric(finding(quantity="eloc"))
    assert of_metric(Finding("ros.comment_ratio.min", "warning", ""))
    assert of_metric(Finding("ros.class_limits", "note", ""))
    assert not of_metric(Finding("package.maximum", "warning", ""))


def rebuilt(folder, **more):
    case = ReportCase(title="", source="o/n#1", ros=2, distro="", area="launch", good="clean", **more)
    return Rebuilt("01-case", folder, case)


def test_warnings_in_the_correct_form_are_false_alarms(workspace):
    def run(folder):
        return Said([finding(), finding("note"), finding(quantity="eloc")] if folder.name == "good" else [], [])

    scored = score(rebuilt(workspace, bad=[PLACE]), run)
    assert (scored.verdict, scored.alarms) == ("silent", [str(finding())])
    assert score(rebuilt(workspace), run).verdict is None
