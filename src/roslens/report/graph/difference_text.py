"""Differences of computation graphs in words: for a terminal, and as Markdown for a pull request."""

from __future__ import annotations

import re
from collections.abc import Sequence

from roslens.compare.finding_difference import FindingDifference
from roslens.compare.graph_difference import Difference
from roslens.model.finding import Finding
from roslens.report.writing.terminal import printable

FOLDED_FROM = 30
MOST_ROWS = 300
_MARKUP = re.compile(r"[\\*\[\]<#|@]|~~|(?<![A-Za-z0-9])_|_(?![A-Za-z0-9])")
_SIGNS = {"added": "+", "removed": "-", "changed": "~"}


def to_text(found: Sequence[Difference], before: str, after: str, findings: FindingDifference | None = None) -> str:
    """Return differences as lines, by node, and what became of findings; None where nobody looked for any."""
    lines = [f"--- {before}", f"+++ {after}"]
    node = None
    for one in found:
        if one.what == "node" and not one.name:
            lines.append(f"{_SIGNS[one.how]} {one.node}  {one.before or one.after}")
            node = one.node
            continue
        if one.node != node:
            node = one.node
            lines.append(f"  {node or 'parameters of all nodes'}")
        lines.append(f"{_SIGNS[one.how]}   {one.what} {one.name}: {_change(one)}")
    if not found:
        lines.append("no difference in the graph" if findings else "no difference")
    if findings is not None and (findings or findings.moved):
        lines.append(f"findings: {_count(findings)}")
        lines += [f"{sign} {_reported(one)}" for sign, side in _sides(findings) for one in side]
        lines += [f"= {_place(one.before)} is now {_reported(one.after)}" for one in findings.moved]
    return "".join(f"{printable(line)}\n" for line in lines)


def _change(one: Difference) -> str:
    if one.how != "changed":
        return one.before or one.after
    if one.before and one.after:
        return f"{one.before} -> {one.after}"
    return f"also {one.after}" if one.after else f"no more {one.before}"


def _sides(findings: FindingDifference) -> tuple[tuple[str, tuple[Finding, ...]], ...]:
    return ("+", findings.new), ("-", findings.gone)


def _count(findings: FindingDifference) -> str:
    counts = {"new": len(findings.new), "gone": len(findings.gone), "moved": len(findings.moved)}
    return ", ".join(f"{number} {how}" for how, number in counts.items() if number)


def _reported(one: Finding) -> str:
    return f"{_place(one)}: {one.severity.value}: {one.message} [{one.rule}]"


def _place(one: Finding) -> str:
    return f"{one.path}:{one.line}" if one.line else one.path


def to_markdown(found: Sequence[Difference], before: str, after: str, findings: FindingDifference | None = None) -> str:
    """Return differences as tables for a pull request, folded where long; a forge refuses what is endless.

    Findings come first: they are what a reviewer has to decide about.
    """
    head = f"**Computation graph**: `{_cell(before)}` to `{_cell(after)}`"
    of_interest = findings if findings is not None and (findings or findings.moved) else None
    if not found and of_interest is None:
        return f"{head}: no difference\n"
    parts = [f"{head}: {_summary(found, of_interest)}"]
    if findings:
        parts.append(_finding_table(findings))
    if found:
        parts.append(_difference_table(found))
    return "\n\n".join(parts) + "\n"


def _summary(found: Sequence[Difference], findings: FindingDifference | None) -> str:
    count = {how: sum(one.how == how for one in found) for how in _SIGNS}
    words = ", ".join(f"{number} {how}" for how, number in count.items() if number) or "no difference"
    return words if findings is None else f"{words}; findings: {_count(findings)}"


def _finding_table(findings: FindingDifference) -> str:
    rows = []
    for how, side in (("new", findings.new), ("gone", findings.gone)):
        for one in side:
            where = f"{how} | {one.severity.value} | {_code(one.rule)} | {_code(_place(one))}"
            rows.append(f"| {where} | {_prose(one.message)} |")
    for pair in findings.moved:
        where = f"moved | {pair.after.severity.value} | {_code(pair.after.rule)} | {_code(_place(pair.after))}"
        rows.append(f"| {where} | was at {_code(_place(pair.before))}: {_prose(pair.after.message)} |")
    return _table("| finding | severity | rule | where | what |", rows, f"Findings: {_count(findings)}")


def _difference_table(found: Sequence[Difference]) -> str:
    rows = []
    for one in found:
        what = f"{one.what} {_code(one.name)}" if one.name else one.what
        rows.append(f"| {one.how} | {_code(one.node)} | {what} | {_code(one.before)} | {_code(one.after)} |")
    nodes = len({one.node for one in found})
    return _table("| | node | what | before | after |", rows, f"{len(found)} differences in {nodes} nodes")


def _table(head: str, rows: Sequence[str], title: str) -> str:
    lines = [head, f"{'| --- ' * (head.count('|') - 1)}|", *rows[:MOST_ROWS]]
    if len(rows) > MOST_ROWS:
        lines += ["", f"{len(rows) - MOST_ROWS} more are not shown: `roslens graph --diff` lists all."]
    if len(rows) > FOLDED_FROM:
        lines = [f"<details><summary>{title}</summary>", "", *lines, "", "</details>"]
    return "\n".join(lines)


def _code(text: str) -> str:
    return f"`{_cell(text)}`" if text else ""


def _cell(text: str) -> str:
    return printable(" ".join(text.split())).replace("|", "\\|").replace("`", "'")


def _prose(text: str) -> str:
    """Return words that a forge shows as they are: no mark-up but code, no mention, no link."""
    parts = printable(" ".join(text.split())).split("`")
    if not len(parts) % 2:
        parts = ["'".join(parts)]
    return "".join(_code(part) if number % 2 else _MARKUP.sub(r"\\\g<0>", part) for number, part in enumerate(parts))
