"""Which findings of a table are still reported, after what they showed was mended."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import yaml

from graph_findings.judgements import ROOT, Sample

COUNTS = ROOT / "tests" / "fixtures" / "first_findings" / "again.yaml"
Left = tuple[int, int, int, int]
"""True and not true findings that were read, and how many of both are still warnings or errors."""


def left_of(sample: Sample, found: Mapping[str, Sequence[Mapping[str, Any]]]) -> Left:
    """Return what is left of the judged findings of a sample.

    Args:
        sample: with verdicts.
        found: findings of the same commits now, by repository.
    """
    now = {
        (name, one["rule"], one.get("path", ""), one.get("line", 0), one.get("entity", ""))
        for name, findings in found.items()
        for one in findings
        if one["severity"] != "note"
    }
    counts = {verdict: [0, 0] for verdict in (True, False)}
    for one in sample.findings:
        if one.verdict is not None:
            count = counts[one.verdict]
            count[0] += 1
            count[1] += (one.repository, one.rule, one.path, one.line, one.entity) in now
    return counts[True][0], counts[False][0], counts[True][1], counts[False][1]


def read_again() -> dict[str, Left]:
    """Return what is left of each table that was looked at again, by its name."""
    if not COUNTS.is_file():
        return {}
    return {name: tuple(counts) for name, counts in yaml.safe_load(COUNTS.read_text("utf-8")).items()}


def write_again(name: str, left: Left) -> None:
    """Keep what is left of a table."""
    known = {**read_again(), name: left}
    rows = {key: list(value) for key, value in sorted(known.items())}
    COUNTS.write_text(yaml.safe_dump(rows, default_flow_style=None), "utf-8")
