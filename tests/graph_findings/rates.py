"""How often coding rules report in the field: findings that count per thousand lines of own code."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

from graph_findings.judgements import ROOT

RATES = ROOT / "src" / "roslens" / "source" / "rules" / "field" / "rates.toml"
_HEAD = """\
# Findings that count of each rule that is on by default, and in how many of the repositories it reports any:
# `python -m graph_findings rates FOLDER` writes it. `lines` are of own code.
"""


def lines_of(report: Mapping[str, Any]) -> float:
    """Return the lines of own code that a report of ``roslens check`` in JSON counts."""
    own = {f"file:{file['path']}" for file in report["files"] if file["role"] == "own"}
    return sum(one["value"] for one in report["measurements"] if one["quantity"] == "loc" and one["entity"] in own)


def rates_text(reports: Iterable[Mapping[str, Any]]) -> str:
    """Return the table as text: of each rule the number of findings and of repositories.

    Args:
        reports: of each repository, as ``roslens check --format json`` writes it.
    """
    findings: Counter[str] = Counter()
    repositories: Counter[str] = Counter()
    lines, number = 0.0, 0
    for report in reports:
        number += 1
        lines += lines_of(report)
        found = Counter(
            one["rule"] for one in report["findings"] if one.get("tool") == "roslens" and one.get("gated", True)
        )
        findings += found
        repositories.update(found.keys())
    rows = [f'"{rule}" = [{count}, {repositories[rule]}]' for rule, count in sorted(findings.items())]
    return "\n".join((f"{_HEAD}lines = {lines:.0f}", f"repositories = {number}", "", "[rules]", *rows)) + "\n"
