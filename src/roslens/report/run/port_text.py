"""What breaks between two distributions of ROS: as lines, as Markdown, and as a document."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from roslens.model.distributions.port import Port
from roslens.model.finding import Finding
from roslens.model.words.plural import plural
from roslens.report.writing.terminal import printable

SCHEMA = "roslens-port/1"
"""Name and version; within a version keys are only added."""


def port_lines(port: Port) -> list[str]:
    """Return a port as lines: what breaks by consequence, worst first, then what else there is to do."""
    lines = [_headline(port)]
    for title, findings in _groups(port):
        lines += ["", f"{title} ({len(findings)})"]
        lines += [f"  {_place(one)}  {one.message}{' [fix]' if one.edits else ''}" for one in findings]
    if port.fixable:
        lines += ["", f"{_mechanical(port)}: --diff shows the changes, --fix makes them"]
    return [printable(line) for line in lines]


def port_markdown(port: Port) -> str:
    """Return a port as Markdown: a list to work through."""
    lines = [f"### {_headline(port)}"]
    for title, findings in _groups(port):
        lines += ["", f"#### {title} ({len(findings)})", ""]
        lines += [
            f"- [ ] `{_place(one)}`: {printable(one.message)}{' (has a fix)' if one.edits else ''}" for one in findings
        ]
    if port.fixable:
        lines += ["", f"{_mechanical(port)} by `roslens port {port.before} {port.after} --fix`."]
    return "\n".join(lines) + "\n"


def port_document(port: Port) -> dict[str, Any]:
    """Return a port as a document."""
    return {
        "schema": SCHEMA,
        "from": port.before,
        "to": port.after,
        "breaks": [_finding(one) for of in port.by_consequence().values() for one in of],
        "deprecated": [_finding(one) for one in port.deprecated],
        "already": [_finding(one) for one in port.already],
    }


def _groups(port: Port) -> Iterator[tuple[str, Sequence[Finding]]]:
    for consequence, findings in port.by_consequence().items():
        yield f"{consequence.value} in {port.after.capitalize()}", findings
    if port.deprecated:
        yield f"deprecated in {port.after.capitalize()}, and still there", port.deprecated
    if port.already:
        yield f"not in {port.before.capitalize()} either", port.already


def _headline(port: Port) -> str:
    way = f"from {port.before.capitalize()} to {port.after.capitalize()}"
    if not (port.breaks or port.deprecated or port.already):
        return f"{way}: nothing that is used is known to change"
    return f"{way}: {plural(len(port.breaks), 'place')} to change, {len(port.deprecated)} deprecated"


def _mechanical(port: Port) -> str:
    return f"{port.fixable} of {plural(len(port.breaks) + len(port.already), 'place')} can be changed mechanically"


def _place(finding: Finding) -> str:
    return f"{finding.path}:{finding.line}" if finding.line else finding.path


def _finding(one: Finding) -> dict[str, Any]:
    consequence, certainty = one.weight
    return {
        "rule": one.rule, "consequence": consequence.value, "certainty": certainty.value, "path": one.path,
        "line": one.line, "column": one.column, "message": one.message, "fix": bool(one.edits),
    }  # fmt: skip
