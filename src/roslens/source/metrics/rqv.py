"""Findings of quality models (#RQV)."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.model.entity import EntityKind
from roslens.model.finding import Finding
from roslens.model.quantity import Quantity

QUANTITY = Quantity(
    key="rqv",
    title="Quality model violations",
    unit="findings",
    kinds=(EntityKind.PACKAGE,),
    text="How often a threshold of the chosen quality models is broken.",
    formula="number of findings that a quality model makes",
    source="Santos et al., A Framework for Quality Assessment of ROS Repositories, IROS 2016 (#RQV)",
    limits="It depends on which models are chosen (the paper's is the ROS model) and grows with the size of the "
    "package. Findings that are suppressed or outside the gate (tests, generated, vendored) do not count.",
)


def of_findings(findings: Iterable[Finding]) -> float:
    """Return how many of the findings were made by a quality model."""
    return sum(1 for finding in findings if finding.model)
