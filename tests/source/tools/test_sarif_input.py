"""SARIF of any tool: findings in the workspace, and whatever is wrong with it is said."""

import json
from typing import Any

import pytest

from roslens.model.finding import Severity
from roslens.source.tools.sarif import sarif_input
from roslens.source.tools.sarif.sarif_input import SarifError, read_sarif, tool_name

ROOT = "/robot"


def result(uri="src/a.cpp", rule="sql", **more) -> dict[str, Any]:
    place = {"artifactLocation": {"uri": uri}, "region": {"startLine": 4, "startColumn": 2, "endColumn": 9}}
    return {"ruleId": rule, "message": {"text": "bad  query"}, "locations": [{"physicalLocation": place}], **more}


def log(*results, driver=None, **more) -> bytes:
    tool = {"driver": {"name": "Semgrep OSS", "semanticVersion": "1.2.3", **(driver or {})}}
    run = {"tool": tool, "results": list(results), **more}
    return json.dumps({"version": "2.1.0", "runs": [run]}).encode()


def read(*results, **more):
    return read_sarif(log(*results, **more), ROOT)


def test_a_result():
    rules = [{"id": "sql", "shortDescription": {"text": "SQL from strings"}, "helpUri": "https://example.org/sql"}]
    rules[0]["properties"] = {"tags": ["security"]}
    imported = read(result(level="error"), driver={"rules": rules})
    (one,) = imported.findings["semgrep_oss"]
    assert (one.path, one.line, one.column, one.end_column) == ("src/a.cpp", 4, 2, 8)
    assert (one.check, one.message, one.level) == ("sql", "bad query", "error")
    rule = imported.rules["semgrep_oss.sql"]
    assert (rule.title, rule.severity, rule.url) == ("SQL from strings", Severity.ERROR, "https://example.org/sql")
    assert rule.tags == ("semgrep_oss", "security")
    assert imported.versions == {"semgrep_oss": "1.2.3"}
    assert imported.trouble == ()


@pytest.mark.parametrize(
    ("uri", "path"),
    [
        ("file:///robot/src/a%20b.cpp", "src/a b.cpp"),
        ("./src/../src/a.cpp", "src/a.cpp"),
        ("/robot/src/a.cpp", "src/a.cpp"),
        ("file:///etc/passwd", None),
        ("../outside.cpp", None),
        ("https://example.org/a.cpp", None),
        ("file://host/robot/a.cpp", None),
        ("a%00b", None),
        ("http://[", None),
    ],
)
def test_places(uri, path):
    imported = read(result(uri))
    found = [one.path for one in imported.findings.get("semgrep_oss", ())]
    assert found == ([path] if path else [])
    assert imported.trouble == (() if path else ("1 results that point outside of the workspace were left out",))


def test_places_by_base_and_by_index():
    bases = {
        "SRC": {"uri": "src/", "uriBaseId": "TOP"},
        "TOP": {"uri": "file:///robot/"},
        "LOOP": {"uriBaseId": "LOOP"},
    }
    based = result("a.cpp")
    based["locations"][0]["physicalLocation"]["artifactLocation"]["uriBaseId"] = "SRC"
    looped = result("b.cpp")
    looped["locations"][0]["physicalLocation"]["artifactLocation"]["uriBaseId"] = "LOOP"
    indexed = result()
    indexed["locations"][0]["physicalLocation"]["artifactLocation"] = {"index": 0}
    artifacts = [{"location": {"uri": "src/c.cpp"}}]
    imported = read(based, looped, indexed, originalUriBaseIds=bases, artifacts=artifacts)
    assert [one.path for one in imported.findings["semgrep_oss"]] == ["b.cpp", "src/a.cpp", "src/c.cpp"]


def test_what_is_no_finding():
    imported = read(
        result(kind="pass"),
        result(suppressions=[{"kind": "inSource"}]),
        {"message": {"text": "no place"}},
        result("b.cpp", suppressions=[{"kind": "external", "status": "rejected"}]),
    )
    assert [one.path for one in imported.findings["semgrep_oss"]] == ["b.cpp"]
    assert imported.trouble == ("1 results without a place were left out", "1 suppressed results were left out")


def test_messages_and_levels_of_the_rule():
    rules = [{"id": "r", "messageStrings": {"m": {"text": "{0} of {1}"}}, "defaultConfiguration": {"level": "note"}}]
    given = result(rule="r", message={"id": "m", "arguments": ["one", "two"]}, ruleIndex=0)
    (one,) = read(given, driver={"rules": rules}).findings["semgrep_oss"]
    assert (one.message, one.level) == ("one of two", "note")


def test_a_run_that_failed_says_so():
    notes = [{"message": {"text": "out of memory"}}]
    failed = [{"executionSuccessful": False, "toolExecutionNotifications": notes}]
    assert read(invocations=failed).trouble == ("Semgrep OSS reports that its run failed: out of memory",)
    document = {"version": "2.1.0", "runs": [{"tool": {"driver": {"name": "x"}}}]}
    assert "did not run to its end" in read_sarif(json.dumps(document).encode(), ROOT).trouble[0]


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\x00\xff",
        b"[]",
        b"{}",
        b'{"version": "1.0.0", "runs": []}',
        b'{"version": "2.1.0"}',
        b'{"version": "2.1.0", "runs": [{"tool": {}}]}',
        b'{"version": "2.1.0", "runs": [{"tool": {"driver": {"name": "x"}}, "results": [{"ruleId": 3}]}]}',
        b"[" * 100_000,
    ],
)
def test_what_is_no_sarif(content):
    with pytest.raises(SarifError):
        read_sarif(content, ROOT)


def test_more_results_than_anybody_reads(monkeypatch):
    monkeypatch.setattr(sarif_input, "MOST_RESULTS", 2)
    with pytest.raises(SarifError, match="3 results; at most 2"):
        read(result(), result("b.cpp"), result("c.cpp"))


@pytest.mark.parametrize(
    ("name", "plain"), [("Clang-Tidy", "clang_tidy"), ("CodeQL", "codeql"), ("3M!", "tool_3m"), ("§", "sarif")]
)
def test_names(name, plain):
    assert tool_name(name) == plain
