"""Findings of quality models (#RQV)."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.judge.quality.fold_limits import EXTREME, limits_broken
from roslens.model.entity import EntityKind
from roslens.model.finding import Finding
from roslens.model.quantity import Quantity

QUANTITY = Quantity(
    key="rqv",
    title="Quality model violations",
    unit="findings",
    kinds=(EntityKind.PACKAGE,),
    text="How often a threshold of the chosen quality models is broken.",
    formula="number of thresholds that are broken; one function that breaks three counts three times",
    source="Santos et al., A Framework for Quality Assessment of ROS Repositories, IROS 2016 (#RQV)",
    limits="It depends on which models are chosen (the paper's is the ROS model) and grows with the size of the "
    "package. The model `extreme`, whose limits lie beyond those of others, does not count, nor do findings "
    "that are suppressed or outside the gate (tests, generated, vendored).",
)


def of_findings(findings: Iterable[Finding]) -> float:
    """Return how many thresholds of quality models the findings report as violated."""
    return sum(not rule.startswith(f"{EXTREME}.") for finding in findings for rule in limits_broken(finding))
