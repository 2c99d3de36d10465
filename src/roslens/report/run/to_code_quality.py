"""Code Quality JSON, as GitLab shows it in merge requests: an array of issues with unique fingerprints."""

from __future__ import annotations

from collections import Counter
from typing import Any, TextIO

import msgspec

from roslens.model.finding import Severity, fingerprint
from roslens.report.run.reported import Reported, Wanted, reported
from roslens.store.read import RunView

_SEVERITIES = {Severity.NOTE: "info", Severity.WARNING: "minor", Severity.ERROR: "critical"}


def write_code_quality(view: RunView, stream: TextIO, wanted: Wanted) -> None:
    """Write the findings that count; what has no file of its own stands at the manifest of its package.

    Raises:
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    seen: Counter[str] = Counter()
    issues = []
    for one in reported(view, wanted):
        own = one.finding.fingerprint or fingerprint(one.finding.rule, one.path, one.finding.message)
        # GitLab shows one of several issues with one fingerprint.
        issues.append(_issue(one, f"{own}-{seen[own]}" if seen[own] else own))
        seen[own] += 1
    stream.write(msgspec.json.format(msgspec.json.encode(issues), indent=1).decode() + "\n")


def _issue(one: Reported, unique: str) -> dict[str, Any]:
    lines = {"begin": one.line}
    if one.finding.end_line > one.line:
        lines["end"] = one.finding.end_line
    return {
        "description": one.finding.message,
        "check_name": one.finding.rule,
        "fingerprint": unique,
        "severity": _SEVERITIES[one.finding.severity],
        "location": {"path": one.path or ".", "lines": lines},
    }
