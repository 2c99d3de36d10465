"""The difference of two runs: as lines, as Markdown for a pull request, and as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import msgspec

from roslens.compare.run_difference import RunDifference, ValueChange
from roslens.model.finding import Finding, Severity
from roslens.report.run.fix_first import by_urgency
from roslens.report.writing.numbers import plain
from roslens.report.writing.terminal import printable

SCHEMA = "roslens-comparison/1"
"""Name and version; within a version keys are only added."""

SHOWN = ("loc", "functions", "cyclomatic_complexity.max", "cognitive_complexity.max", "duplication_ratio")
"""Quantities whose changes are shown to readers; JSON has all of them."""

MOST = 40


def difference_lines(found: RunDifference, before: str, after: str) -> str:
    """Return the difference as text; ``before`` and ``after`` are what the runs are called."""
    lines = [f"--- {before}", f"+++ {after}", *_made_by(found)]
    lines += [f"- package {one}" for one in found.removed] + [f"+ package {one}" for one in found.added]
    lines += [f"= package {one.package}: {one.after}, was in {one.before}" for one in found.moved]
    lines.append(_count(found))
    for sign, side in (("+", found.findings.new), ("-", found.findings.gone)):
        ordered = by_urgency(side)
        lines += [f"{sign} {_reported(one)}" for one in ordered[:MOST]]
        if len(ordered) > MOST:
            lines.append(f"{sign} {len(ordered) - MOST} more: --format json has all")
    lines += [f"= {_reported(one.after)}, was in {one.before.path}" for one in found.findings.moved[:MOST]]
    shown = [one for one in found.values if one.quantity in SHOWN]
    if shown:
        lines.append("measured")
        lines += [f"~ {one.package}: {one.quantity} {_number(one.before)} -> {_number(one.after)}" for one in shown]
    if not (found.findings or found.findings.moved or found.added or found.removed or found.moved or found.values):
        lines.append("no difference")
    return "".join(f"{printable(line)}\n" for line in lines)


def difference_markdown(found: RunDifference, before: str, after: str) -> str:
    """Return the difference as Markdown."""
    lines = [f"### roslens: {_code(before)} → {_code(after)}", "", _count(found), ""]
    lines += [f"- {line}" for line in _made_by(found)]
    lines += [
        f"- package {_code(one.package)} was in {_code(one.before)}, is in {_code(one.after)}" for one in found.moved
    ]
    if lines[-1].startswith("- "):
        lines.append("")
    for title, side in (("New", found.findings.new), ("Resolved", found.findings.gone)):
        if side:
            rows = [f"| {one.severity.value} | {_code(_place(one))} | {_cell(one.message)} | {_code(one.rule)} |"
                    for one in by_urgency(side)[:MOST]]  # fmt: skip
            more = [f"{len(side) - MOST} more."] if len(side) > MOST else []
            head = ["| severity | place | finding | rule |", "| --- | --- | --- | --- |"]
            lines += [
                "<details open>" if title == "New" else "<details>",
                f"<summary>{title}: {len(side)}</summary>",
                "",
            ]
            lines += [*head, *rows, "", *more, "</details>", ""]
    shown = [one for one in found.values if one.quantity in SHOWN]
    if shown:
        lines += ["| package | quantity | before | after |", "| --- | --- | ---: | ---: |"]
        lines += [
            f"| {_code(one.package)} | {one.quantity} | {_number(one.before)} | {_number(one.after)} |"
            for one in shown[:MOST]
        ]
    return "\n".join(lines).rstrip() + "\n"


def difference_json(
    found: RunDifference,
    before: Mapping[str, Any],
    after: Mapping[str, Any],
    interfaces: Mapping[str, Any] | None = None,
) -> str:
    """Return the difference as one document; ``before`` and ``after`` describe the runs."""
    document = {
        "schema": SCHEMA,
        "before": dict(before),
        "after": dict(after),
        "new": [_document(one) for one in found.findings.new],
        "resolved": [_document(one) for one in found.findings.gone],
        "moved": [{**_document(one.after), "was_in": one.before.path} for one in found.findings.moved],
        "packages_added": found.added,
        "packages_removed": found.removed,
        "packages_moved": [{"package": one.package, "was_in": one.before, "path": one.after} for one in found.moved],
        "values": [_value(one) for one in found.values],
        "measured_by": [{"name": name, "before": was, "after": now} for name, was, now in found.measured_by],
        "interfaces": interfaces,
    }
    return msgspec.json.format(msgspec.json.encode(document), indent=1).decode() + "\n"


def _made_by(found: RunDifference) -> Iterator[str]:
    for name, was, now in found.measured_by:
        yield f"{name} was {was} and is {now}: what differs may come from that"


def _count(found: RunDifference) -> str:
    new, gone, moved = found.findings.new, found.findings.gone, found.findings.moved
    parts = [f"{_by_severity(new)} new", f"{_by_severity(gone)} resolved", f"{len(moved)} moved"]
    return f"findings: {', '.join(parts)}"


def _by_severity(found: Sequence[Finding]) -> str:
    counts = {one: sum(finding.severity is one for finding in found) for one in reversed(list(Severity))}
    reported = [f"{number} {one.value}{'s' if number != 1 else ''}" for one, number in counts.items() if number]
    return f"{len(found)} ({', '.join(reported)})" if reported else "0"


def _place(one: Finding) -> str:
    return f"{one.path}:{one.line}" if one.line else one.path or one.entity


def _reported(one: Finding) -> str:
    return f"{_place(one)}: {one.severity.value}: {one.message} [{one.rule}]"


def _number(value: float | None) -> str:
    return "none" if value is None else f"{plain(round(value, 2)):,}"


def _code(text: str) -> str:
    return f"`{printable(text).replace('`', chr(39))}`"


def _cell(text: str) -> str:
    return printable(text).replace("|", "\\|").replace("<", "&lt;")


def _document(one: Finding) -> dict[str, Any]:
    return {
        "rule": one.rule, "severity": one.severity.value, "message": one.message, "path": one.path, "line": one.line,
        "entity": one.entity, "fingerprint": one.fingerprint,
    }  # fmt: skip


def _value(one: ValueChange) -> dict[str, Any]:
    sides = {"before": one.before, "after": one.after}
    reported = {name: None if value is None else plain(value) for name, value in sides.items()}
    return {"package": one.package, "quantity": one.quantity, **reported}
