"""Findings of coding rules (#RCV)."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.model.entity import EntityKind
from roslens.model.finding import Finding
from roslens.model.quantity import Quantity

QUANTITY = Quantity(
    key="rcv",
    title="Coding rule violations",
    unit="findings",
    kinds=(EntityKind.PACKAGE,),
    text="How often a coding rule is broken.",
    formula="number of findings that no quality model makes",
    source="Santos et al., A Framework for Quality Assessment of ROS Repositories, IROS 2016 (#RCV)",
    limits="It depends on which tools ran and grows with the size of the package. The paper's data has the "
    "thresholds of all models but ROS in it; this has none. Findings that are suppressed or outside the gate do not "
    "count.",
)


def of_findings(findings: Iterable[Finding]) -> float:
    """Return how many of the findings were made by a coding rule."""
    return sum(1 for finding in findings if not finding.model)
