from __future__ import annotations

from roslens.source.metrics import rcv


def test_values_worked_out_by_hand(example_findings):
    findings, expected = example_findings("rcv")
    assert rcv.of_findings(findings) == expected


def test_no_findings_are_none():
    assert rcv.of_findings([]) == 0
