from __future__ import annotations

from roslens.source.metrics.halstead import halstead_time


def test_it_is_an_eighteenth_of_the_effort():
    assert halstead_time.of_values({"halstead_effort": 36.0}) == 2
