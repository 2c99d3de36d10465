"""Findings of which each is named: what stops the build or the start, and what is wrong at run time."""

from __future__ import annotations

from roslens.model.finding import Finding
from roslens.model.tags import TagFilter
from roslens.store.read import RunView


def grave_findings(view: RunView, tags: TagFilter | None = None) -> tuple[Finding, ...]:
    """Return the findings of a run that count and have a grave consequence, whatever their severity.

    Raises:
        StoreError: the store cannot be read.
    """
    wanted = tags or TagFilter()
    rules = {
        one.rule
        for package in view.packages()
        for one in package.rules
        if one.gated and one.weight[0].grave and wanted.matches(one.tags)
    }
    rules.update(one.rule for one in view.workspace.findings if one.gated and one.weight[0].grave)
    return tuple(
        finding
        for rule in sorted(rules)
        for finding in view.findings(rule=rule, tags=wanted)
        if finding.gated and finding.weight[0].grave
    )
