from __future__ import annotations

from roslens.source.metrics import rqv


def test_values_worked_out_by_hand(example_findings):
    findings, expected = example_findings("rqv")
    assert rqv.of_findings(findings) == expected


def test_no_findings_are_none():
    assert rqv.of_findings([]) == 0
