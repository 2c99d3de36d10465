"""What other programs read: SARIF, JUnit, Code Quality, annotations, Checkstyle, Markdown and a badge."""

import io
import json
import xml.etree.ElementTree as ET
from pathlib import Path

import jsonschema
import msgspec
import pytest

from roslens.judge.quality.gate import GateResult
from roslens.model.edit import Edit
from roslens.model.failure import Failure
from roslens.model.finding import Finding, Severity
from roslens.model.result import WorkspaceResult
from roslens.model.same_finding import key_of_finding
from roslens.model.source import Location
from roslens.model.tags import parse_tags
from roslens.report.run import not_analysed, to_sarif
from roslens.report.run.formats import FORMATS, format_of, write_format
from roslens.report.run.reported import Reported, Wanted, reported

SCHEMA = Path(__file__).parents[1] / "fixtures/report/sarif/sarif-schema-2.1.0.json"
AWKWARD = 'a "b" <c> & d | e` 100 %, @all\r\n::error::no \x1b[31m\x00'


def written(name, view, **wanted):
    stream = io.StringIO()
    write_format(name, view, stream, Wanted(**wanted))
    return stream.getvalue()


def finding(rule="a.rule", severity=Severity.WARNING, message="m", path="src/a b.cpp", line=3, **more):
    return Finding(rule, severity, message, path, line, **more)


@pytest.fixture
def view_with(view_of, sample):
    """Return a function that makes a run of the sample with more findings of its package ``arm``."""

    def make(*findings, failures=()):
        arm = msgspec.structs.replace(sample.arm(), findings=findings, failures=failures)
        return view_of([("a", sample.drive()), ("b", arm)], sample.workspace(), sample.header())

    return make


@pytest.fixture(scope="module")
def sarif_schema():
    return jsonschema.Draft4Validator(json.loads(SCHEMA.read_text("utf-8")))


def sarif(view, **wanted):
    return json.loads(written("sarif", view, **wanted))["runs"][0]


def test_sarif_names_the_witnesses_of_a_result(view_with):
    run = sarif(view_with(finding(witnesses=("cppcheck.zerodiv",)), finding("b.rule")))
    named = {result["ruleId"]: result["properties"].get("witnesses") for result in run["results"]}
    assert named["a.rule"] == ["cppcheck.zerodiv"]
    assert named["b.rule"] is None


def test_findings_that_count_in_the_order_to_fix_them(view_with):
    view = view_with(
        finding(), finding(severity=Severity.ERROR), finding(gated=False), finding(line=1, value=9, bound=1)
    )
    found = reported(view, Wanted(below="ws/"))
    assert [(one.finding.severity.value, one.package, one.path, one.line) for one in found] == [
        ("error", "arm", "ws/src/a b.cpp", 3),
        ("error", "", "ws/src/drive/package.xml", 1),
        ("warning", "arm", "ws/src/a b.cpp", 1),
        ("warning", "arm", "ws/src/a b.cpp", 3),
        ("warning", "drive", "ws/src/drive/src/drive.cpp", 12),
    ]


@pytest.mark.parametrize("name", sorted(FORMATS.keys() - {"text"}))
def test_every_format_writes_any_run(name, view_with, view_of, sample):
    assert written(name, view_of([], WorkspaceResult(), sample.header()))
    text = written(name, view_with(finding(message=AWKWARD), finding(path="", line=0)))
    assert text.endswith("\n")
    assert "\x1b[" not in text or name in {"csv", "github"}


def test_sarif_is_what_the_schema_says(sarif_schema, view, view_with, view_of, sample):
    one = finding(
        message=AWKWARD,
        column=2,
        end_line=3,
        end_column=9,
        entity="function:src/a b.cpp#f()",
        others=("src/b.cpp:7:2 also", "no place"),
        fingerprint="0" * 16,
    )
    failure = Failure("tool", "broke", location=Location("src/x.cpp", 3), package="arm")
    for run in (view, view_with(one, failures=(failure,)), view_of([], WorkspaceResult(), sample.header())):
        sarif_schema.validate(json.loads(written("sarif", run, below="ws/")))


def test_sarif_says_where_what_and_which_rule(view_with):
    run = sarif(view_with(finding(column=2, end_line=3, end_column=9, fingerprint="f" * 16)), below="ws/")
    result = next(one for one in run["results"] if one["ruleId"] == "a.rule")
    assert run["tool"]["driver"]["rules"][result["ruleIndex"]]["id"] == "a.rule"
    place = result["locations"][0]["physicalLocation"]
    assert place["artifactLocation"] == {"uri": "ws/src/a%20b.cpp", "uriBaseId": "%SRCROOT%"}
    assert place["region"] == {"startLine": 3, "startColumn": 2, "endLine": 3, "endColumn": 10}
    assert result["partialFingerprints"] == {"roslensFingerprint/v1": "f" * 16}
    described = next(rule for rule in run["tool"]["driver"]["rules"] if rule["id"] == "ros.cyclomatic_complexity")
    assert "Each path needs a test." in described["help"]["markdown"]
    assert described["defaultConfiguration"] == {"level": "warning"}


def test_sarif_names_related_places(view_with):
    message = "f in src/drive/src/drive.cpp:7:2 and src/nowhere.cpp:3"
    results = sarif(view_with(finding(message=message)))["results"]
    (first,) = next(one for one in results if one["ruleId"] == "a.rule")["relatedLocations"]
    assert first["physicalLocation"]["artifactLocation"]["uri"] == "src/drive/src/drive.cpp"
    assert first["physicalLocation"]["region"] == {"startLine": 7, "startColumn": 2}
    listed = Reported("", finding(others=("src/b.cpp:7 too", "nowhere")), "src/a b.cpp", 3)
    found = to_sarif._result(listed, 0, "", ())["relatedLocations"]
    assert [one.get("physicalLocation", {}).get("region") for one in found] == [{"startLine": 7}, None]


def test_sarif_has_the_fixes_of_a_result(view_with, sarif_schema):
    edits = (
        Edit("src/a b.cpp", 12, 16, "nullptr", 2, 3, 2, 7, "f" * 40),
        Edit("package.xml", 5, 5, "<depend/>", 1, 6, 1, 6, "e" * 40),
        Edit("src/a b.cpp", 2, 9, "", 1, 3, 1, 10, "f" * 40),
    )
    view = view_with(finding(edits=edits), finding("b.rule"))
    sarif_schema.validate(json.loads(written("sarif", view, below="ws/")))
    (mended,) = [one for one in sarif(view, below="ws/")["results"] if "fixes" in one]
    (fix,) = mended["fixes"]
    manifest, source = fix["artifactChanges"]
    assert manifest["artifactLocation"] == {"uri": "ws/package.xml", "uriBaseId": "%SRCROOT%"}
    assert manifest["replacements"] == [
        {
            "deletedRegion": {"startLine": 1, "startColumn": 6, "endLine": 1, "endColumn": 6},
            "insertedContent": {"text": "<depend/>"},
        }
    ]
    assert source["artifactLocation"]["uri"] == "ws/src/a%20b.cpp"
    assert source["replacements"] == [
        {"deletedRegion": {"startLine": 1, "startColumn": 3, "endLine": 1, "endColumn": 10}},
        {
            "deletedRegion": {"startLine": 2, "startColumn": 3, "endLine": 2, "endColumn": 7},
            "insertedContent": {"text": "nullptr"},
        },
    ]


def test_sarif_leaves_out_the_least_severe_and_says_so(view_with, monkeypatch):
    monkeypatch.setattr(to_sarif, "MOST_RESULTS", 2)
    run = sarif(view_with(finding(), finding(severity=Severity.ERROR)))
    assert [one["level"] for one in run["results"]] == ["error", "error"]
    notes = [one["message"]["text"] for one in run["invocations"][0]["toolExecutionNotifications"]]
    assert any("2 less severe results are left out" in note for note in notes)


def test_sarif_says_what_was_not_analysed(view):
    run = sarif(view)
    (invocation,) = run["invocations"]
    assert invocation["executionSuccessful"] is False
    assert any("src/bad/package.xml" in one["message"]["text"] for one in invocation["toolExecutionNotifications"])


def junit(view, **wanted):
    return ET.fromstring(written("junit", view, **wanted))


def test_junit_fails_what_the_check_fails(view_with):
    view = view_with(finding(severity=Severity.ERROR, message=AWKWARD), finding(severity=Severity.NOTE))
    root = junit(view)
    suites = {one.get("name"): one for one in root}
    arm = suites["roslens.arm"]
    assert (arm.get("tests"), arm.get("failures"), arm.get("errors")) == ("1", "1", "0")
    assert arm.find("testcase").get("name") == "a.rule src/a b.cpp:3"
    assert "src/a b.cpp:3: note: m" in arm.find("system-out").text
    assert junit(view, fail_on="never").get("failures") == "0"
    assert junit(view, fail_on="note").get("failures") == "4"


def test_junit_counts_what_was_not_analysed_as_errors(view):
    root = junit(view)
    assert {one.get("name"): one.get("errors") for one in root} == {
        "roslens.arm": "0",
        "roslens.drive": "1",
        "roslens.workspace": "1",
    }
    assert (root.get("tests"), root.get("errors")) == ("4", "2")
    assert junit(view, accept_partial=True).get("errors") == "1"
    passed = next(one for one in root if one.get("name") == "roslens.arm").find("testcase")
    assert passed is not None
    assert len(passed) == 0


GATE = (GateResult("errors", False, "1 error, at most 0"), GateResult("warnings", True, "1 warning, at most 9"))


def test_a_broken_gate_is_a_failed_test_and_an_annotation(view):
    root = junit(view, fail_on="never", gate=GATE)
    assert (root.get("tests"), root.get("failures")) == ("5", "1")
    assert [one.get("name") for one in root.iter("testcase") if one.find("failure") is not None] == ["errors"]
    assert "::error title=gate errors::1 error, at most 0" in written("github", view, gate=GATE)


def test_what_the_baseline_has_fails_no_test(view):
    assert junit(view, fail_on="warning").get("failures") == "2"
    assert junit(view, fail_on="warning", new=frozenset()).get("failures") == "0"
    old = {key_of_finding(one) for one in view.findings() if one.rule != "manifest.cycle"}
    new = frozenset(key_of_finding(one) for one in view.findings()) - old
    assert junit(view, fail_on="warning", new=new).get("failures") == "1"


def test_a_manifest_that_should_say_something_else_is_no_error(view_with):
    failure = Failure(
        not_analysed.MANIFEST, "no e-mail", location=Location("src/arm/package.xml", 3), package="arm", partial=True
    )
    assert junit(view_with(failures=(failure,))).find("testsuite").get("errors") == "0"


def test_code_quality_has_unique_fingerprints(view_with):
    issues = json.loads(
        written("gitlab", view_with(finding(fingerprint="a"), finding(fingerprint="a", line=9)), below="x/")
    )
    assert len({one["fingerprint"] for one in issues}) == len(issues) == 4
    assert issues[0] == {
        "description": "drive -> arm -> drive",
        "check_name": "manifest.cycle",
        "fingerprint": "e" * 16,
        "severity": "critical",
        "location": {"path": "x/src/drive/package.xml", "lines": {"begin": 1}},
    }


def test_annotations_cannot_be_forged(view_with):
    lines = written("github", view_with(finding(message=AWKWARD, path="a,b:c.cpp"))).splitlines()
    assert sum(line.startswith("::") for line in lines) == 5
    assert lines[-1] == "roslens: 3 findings, 2 failures"
    own = next(line for line in lines if "a.rule" in line)
    assert own.startswith('::warning file=a%2Cb%3Ac.cpp,line=3,title=a.rule::a "b"')
    assert "100 %25, @all%0D%0A::error::no" in own


def test_checkstyle_by_file(view_with):
    root = ET.fromstring(written("checkstyle", view_with(finding(column=4), finding(line=1, severity=Severity.NOTE))))
    (file,) = (one for one in root if one.get("name") == "src/a b.cpp")
    assert [(one.get("line"), one.get("column"), one.get("severity")) for one in file] == [
        ("1", None, "info"),
        ("3", "4", "warning"),
    ]
    assert file[1].get("source") == "roslens.a.rule"


def test_markdown_is_a_summary_and_runs_no_markup(view_with):
    text = written("markdown", view_with(*[finding(line=number + 1, message=AWKWARD) for number in range(30)]))
    assert text.startswith("## roslens: 1 error, 31 warnings\n\n2 packages, 4 files, models ros, commit 0123abc+.\n")
    assert "20 of 32 findings, worst first." in text
    assert "\\<c\\> &amp; d \\| e\\` 100 %, @\u200ball ::error::no" in text
    assert "| arm | 0 | 30 | 0 |" in text
    assert "**Not analysed, or only in part: 2**" in text


@pytest.mark.parametrize(
    ("findings", "said"),
    [
        ((finding(severity=Severity.ERROR),), "2 errors, 1 warning, incomplete"),
        ((), "1 error, 1 warning, incomplete"),
    ],
)
def test_the_badge_says_it_in_words(view_with, findings, said):
    text = written("badge", view_with(*findings))
    assert ET.fromstring(text).get("aria-label") == f"roslens: {said}"


def test_the_badge_is_green_only_where_something_was_looked_at(view_of, sample):
    arm = [("a", sample.arm())]
    assert "no findings" in written("badge", view_of(arm, WorkspaceResult(), sample.header()))
    assert "no packages" in written("badge", view_of([], WorkspaceResult(), sample.header()))
    lost = WorkspaceResult(failures=(Failure("workspace", "broke"),))
    assert "roslens: incomplete" in written("badge", view_of(arm, lost, sample.header()))


def test_tags_filter_every_format(view):
    style = parse_tags("dependencies")
    assert len(sarif(view, tags=style)["results"]) == 1
    assert written("badge", view, tags=style).count("1 error, incomplete")


@pytest.mark.parametrize(
    ("name", "format_"),
    [
        ("a.sarif", "sarif"),
        ("a.sarif.json", "sarif"),
        ("A.JSON", "json"),
        ("b/junit.xml", None),
        ("b/test.junit.xml", "junit"),
        ("b/x.checkstyle.xml", "checkstyle"),
        ("report", "text"),
        ("x.md", "markdown"),
        ("badge.svg", "badge"),
        ("x.html", None),
    ],
)
def test_the_ending_says_the_format(name, format_):
    assert format_of(name) == format_
