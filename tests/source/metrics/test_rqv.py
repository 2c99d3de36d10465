from __future__ import annotations

from roslens.source.metrics.packages import rqv


def test_no_findings_are_none():
    assert rqv.of_findings([]) == 0
