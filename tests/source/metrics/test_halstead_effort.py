from __future__ import annotations

from roslens.source.metrics import halstead_effort


def test_values_worked_out_by_hand(check_example):
    check_example("halstead_effort")


def test_it_is_difficulty_times_volume():
    assert halstead_effort.of_values({"halstead_difficulty": 3.0, "halstead_volume": 7.0}) == 21
