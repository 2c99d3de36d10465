"""SARIF 2.1.0 (OASIS), as code hosts take it: one run, the most severe results first, capped.

GitHub shows the first 5,000 results by severity and refuses a run of more than 25,000; what is left out is said in a
notification of the run.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from typing import Any, TextIO
from urllib.parse import quote

import msgspec

from roslens import __version__
from roslens.model.edit import Edit
from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.set_aside import Disposition, SetAside
from roslens.model.weight.consequence import Certainty
from roslens.report.run.reported import Reported, Wanted, aside, reported, rules_by_id
from roslens.store.read import RunView

MOST_RESULTS = 25_000
"""More in one run are refused by GitHub."""
MOST_TAGS = 20
"""More on one rule are refused by GitHub."""
SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
FINGERPRINT = "roslensFingerprint/v1"
"""Name of the fingerprint of :func:`roslens.model.finding.fingerprint` among the partial fingerprints of a result."""

_LEVELS = {Severity.NOTE: "note", Severity.WARNING: "warning", Severity.ERROR: "error"}
_PRECISIONS = {Certainty.PROVEN: "very-high", Certainty.LIKELY: "high", Certainty.HEURISTIC: "medium"}
"""What code scanning calls the certainty of a rule."""
_PLACE = re.compile(r"(?P<path>[^:\s()\[\]\"'`,;]+):(?P<line>[1-9]\d*)(?::(?P<column>[1-9]\d*))?")
_KINDS = {"class": "type", "function": "function", "file": "resource", "package": "module"}


def write_sarif(view: RunView, stream: TextIO, wanted: Wanted) -> None:
    """Write the findings that count, with their rules, and what could not be analysed.

    Raises:
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    findings = reported(view, wanted)
    shown = findings[:MOST_RESULTS]
    room = MOST_RESULTS - len(shown)
    hushed = list(view.set_aside(tags=wanted.tags))[:room]
    known = rules_by_id(view)
    files = frozenset(file.path for _, file in view.files())
    order = {
        rule: index
        for index, rule in enumerate(
            sorted({*(one.finding.rule for one in shown), *(one.finding.rule for one in hushed)})
        )
    }
    run = {
        "tool": {
            "driver": {
                "name": "roslens",
                "version": __version__,
                "rules": [_rule(rule, known.get(rule)) for rule in order],
            }
        },
        "automationDetails": {"id": f"roslens/{wanted.below}"},
        "invocations": [_invocation(view, wanted, len(findings) - len(shown))],
        "results": [
            *(_since(_result(one, order[one.finding.rule], wanted.below, files), one.finding, wanted) for one in shown),
            *(_suppressed(one, order[one.finding.rule], wanted.below, files) for one in hushed),
        ],
    }
    if view.header.graphs is not None:
        run["properties"] = {"computationGraphs": True}
    document = {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}
    stream.write(msgspec.json.format(msgspec.json.encode(document), indent=1).decode() + "\n")


def _rule(key: str, rule: RuleInfo | None) -> dict[str, Any]:
    if rule is None:
        return {"id": key}
    parts = [part for part in (rule.description, rule.rationale) if part]
    shown: dict[str, Any] = {
        "id": key,
        "shortDescription": {"text": rule.title or key},
        "fullDescription": {"text": rule.description or rule.title or key},
        "help": {
            "text": "\n\n".join((*parts, f"More: roslens explain {key}")),
            "markdown": "\n\n".join((f"**{rule.title or key}**", *parts, f"More: `roslens explain {key}`")),
        },
        "defaultConfiguration": {"level": _LEVELS[rule.severity]},
        "properties": {
            "tags": list(rule.tags[:MOST_TAGS]),
            "problem.severity": _problem(rule.severity),
            "precision": "low" if rule.unproven else _PRECISIONS[rule.weight[1]],
            "consequence": rule.weight[0].value,
            "certainty": rule.weight[1].value,
        },
    }
    if rule.url:
        shown["helpUri"] = rule.url
    return shown


def _problem(severity: Severity) -> str:
    return "recommendation" if severity is Severity.NOTE else severity.value


def _result(one: Reported, index: int, below: str, files: Collection[str]) -> dict[str, Any]:
    finding = one.finding
    shown: dict[str, Any] = {
        "ruleId": finding.rule,
        "ruleIndex": index,
        "level": _LEVELS[finding.severity],
        "message": {"text": finding.message or finding.rule},
        "locations": list(_locations(one)),
        "partialFingerprints": {FINGERPRINT: finding.fingerprint} if finding.fingerprint else {},
        "properties": dict(_properties(one)),
    }
    if related := list(_related(finding, below, files)):
        shown["relatedLocations"] = related
    if finding.edits:
        shown["fixes"] = [_fix(finding.edits, below)]
    return shown


def _fix(edits: Sequence[Edit], below: str) -> dict[str, Any]:
    """Return what mends a finding: the changes of each file, in order of their places."""
    changes: dict[str, list[dict[str, Any]]] = {}
    for edit in sorted(edits):
        replacement: dict[str, Any] = {
            "deletedRegion": {
                "startLine": edit.line,
                "startColumn": edit.column,
                "endLine": edit.end_line,
                "endColumn": edit.end_column,
            }
        }
        if edit.text:
            replacement["insertedContent"] = {"text": edit.text}
        changes.setdefault(edit.path, []).append(replacement)
    return {
        "description": {"text": "Safe, as `roslens check --fix` makes it"},
        "artifactChanges": [
            {
                "artifactLocation": {"uri": quote(below + path), "uriBaseId": "%SRCROOT%"},
                "replacements": replacements,
            }
            for path, replacements in changes.items()
        ],
    }


def _since(result: dict[str, Any], finding: Finding, wanted: Wanted) -> dict[str, Any]:
    if wanted.new is not None:
        result["baselineState"] = "new" if wanted.is_new(finding) else "unchanged"
    return result


def _suppressed(one: SetAside, index: int, below: str, files: Collection[str]) -> dict[str, Any]:
    """Return a result that somebody set aside; readers count it as closed."""
    finding = one.finding
    place = Reported(one.package, finding, below + finding.path if finding.path else "", max(1, finding.line))
    in_source = one.state is Disposition.SUPPRESSED
    suppression: dict[str, Any] = {"kind": "inSource" if in_source else "external", "status": "accepted"}
    if one.reason:
        suppression["justification"] = one.reason
    suppression["properties"] = {"state": one.state.value, "by": one.by}
    shown = _result(place, index, below, files)
    shown.pop("fixes", None)
    return {**shown, "suppressions": [suppression]}


def _locations(one: Reported) -> Iterator[dict[str, Any]]:
    location: dict[str, Any] = {}
    if one.path:
        location["physicalLocation"] = _physical(one.path, _region(one.finding, one.line))
    kind, _, name = one.finding.entity.partition(":")
    if name:
        location["logicalLocations"] = [{"fullyQualifiedName": name, "kind": _KINDS.get(kind, kind)}]
    if location:
        yield location


def _physical(path: str, region: dict[str, int]) -> dict[str, Any]:
    return {"artifactLocation": {"uri": quote(path), "uriBaseId": "%SRCROOT%"}, "region": region}


def _region(finding: Finding, line: int) -> dict[str, int]:
    """Return where a finding is; SARIF's last column is the one behind the last character."""
    region = {"startLine": line}
    if finding.line and finding.column > 0:
        region["startColumn"] = finding.column
    if finding.line and finding.end_line >= finding.line:
        region["endLine"] = finding.end_line
        if finding.column > 0 and finding.end_column > 0:
            region["endColumn"] = finding.end_column + 1
            if finding.end_line == finding.line and finding.end_column < finding.column:
                del region["endColumn"]
    return region


def _related(finding: Finding, below: str, files: Collection[str]) -> Iterator[dict[str, Any]]:
    """Yield the other places of a finding: those that it lists, and those in files of the run that it names."""
    named = (match for match in _PLACE.finditer(finding.message) if match["path"] in files)
    places = [
        (match[0], match) for match in named if (match["path"], int(match["line"])) != (finding.path, finding.line)
    ]
    listed = [(text, _PLACE.search(text)) for text in (*finding.others, *finding.also)]
    for number, (text, place) in enumerate((*listed, *places), 1):
        shown: dict[str, Any] = {"id": number, "message": {"text": text}}
        if place:
            region = {"startLine": int(place["line"])}
            if place["column"]:
                region["startColumn"] = int(place["column"])
            shown["physicalLocation"] = _physical(below + place["path"], region)
        yield shown


def _properties(one: Reported) -> Iterator[tuple[str, Any]]:
    finding = one.finding
    if one.package:
        yield "package", one.package
    yield "tags", list(finding.tags)
    yield "consequence", finding.weight[0].value
    yield "certainty", finding.weight[1].value
    if finding.witnesses:
        yield "witnesses", list(finding.witnesses)
    if finding.quantity:
        yield "quantity", finding.quantity
        if finding.excess:
            yield "excess", round(finding.excess, 3)


def _invocation(view: RunView, wanted: Wanted, cut: int) -> dict[str, Any]:
    failures = view.failures()
    notes = [_failed(failure, wanted.below) for failure in failures]
    if cut:
        notes.append(_note(f"{cut:,} less severe results are left out: a run has at most {MOST_RESULTS:,}"))
    if others := aside(view, wanted.tags):
        notes.append(_note(f"{others:,} findings in test, generated or vendored code do not count and are left out"))
    successful = all(failure.partial for failure in failures)
    return {"executionSuccessful": successful, "toolExecutionNotifications": notes}


def _note(text: str) -> dict[str, Any]:
    return {"level": "note", "message": {"text": text}}


def _failed(failure: Failure, below: str) -> dict[str, Any]:
    shown: dict[str, Any] = {
        "level": "warning" if failure.partial else "error",
        "message": {"text": f"{failure} [{failure.tool}]"},
    }
    if failure.location and failure.location.path and not failure.location.path.startswith("/"):
        region = {"startLine": max(1, failure.location.line)}
        shown["locations"] = [{"physicalLocation": _physical(below + failure.location.path, region)}]
    return shown
