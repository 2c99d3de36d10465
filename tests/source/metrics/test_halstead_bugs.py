from __future__ import annotations

from roslens.source.metrics.halstead import halstead_bugs


def test_it_is_the_volume_in_another_unit():
    assert halstead_bugs.of_values({"halstead_volume": 6000.0}) == 2
