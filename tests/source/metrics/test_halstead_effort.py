from __future__ import annotations

from roslens.source.metrics.halstead import halstead_effort


def test_it_is_difficulty_times_volume():
    assert halstead_effort.of_values({"halstead_difficulty": 3.0, "halstead_volume": 7.0}) == 21
