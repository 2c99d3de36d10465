"""Differences of computation graphs in words: for a terminal, and as Markdown for a pull request."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.compare.graph_difference import Difference
from roslens.report.graph_text import printable

FOLDED_FROM = 30
MOST_ROWS = 300
_SIGNS = {"added": "+", "removed": "-", "changed": "~"}


def to_text(found: Sequence[Difference], before: str, after: str) -> str:
    """Return differences as lines, by node."""
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
        lines.append("no difference")
    return "".join(f"{printable(line)}\n" for line in lines)


def _change(one: Difference) -> str:
    if one.how != "changed":
        return one.before or one.after
    if one.before and one.after:
        return f"{one.before} -> {one.after}"
    return f"also {one.after}" if one.after else f"no more {one.before}"


def to_markdown(found: Sequence[Difference], before: str, after: str) -> str:
    """Return differences as a table for a pull request, folded where it is long; a forge refuses what is endless."""
    head = f"**Computation graph**: `{_cell(before)}` to `{_cell(after)}`"
    if not found:
        return f"{head}: no difference\n"
    count = {how: sum(one.how == how for one in found) for how in _SIGNS}
    told = ", ".join(f"{number} {how}" for how, number in count.items() if number)
    nodes = len({one.node for one in found})
    rows = ["| | node | what | before | after |", "| --- | --- | --- | --- | --- |"]
    for one in found[:MOST_ROWS]:
        what = f"{one.what} {_code(one.name)}" if one.name else one.what
        rows.append(f"| {one.how} | {_code(one.node)} | {what} | {_code(one.before)} | {_code(one.after)} |")
    if len(found) > MOST_ROWS:
        rows += ["", f"{len(found) - MOST_ROWS} more are not shown: `roslens graph --diff` tells all."]
    if len(found) > FOLDED_FROM:
        rows = [f"<details><summary>{len(found)} differences in {nodes} nodes</summary>", "", *rows, "", "</details>"]
    return "\n".join([f"{head}: {told}", "", *rows]) + "\n"


def _code(text: str) -> str:
    return f"`{_cell(text)}`" if text else ""


def _cell(text: str) -> str:
    return printable(" ".join(text.split())).replace("|", "\\|").replace("`", "'")
