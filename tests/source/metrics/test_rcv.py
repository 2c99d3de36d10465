from __future__ import annotations

from roslens.source.metrics.packages import rcv


def test_no_findings_are_none():
    assert rcv.of_findings([]) == 0
