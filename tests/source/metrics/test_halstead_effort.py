from __future__ import annotations

from roslens.source.metrics import halstead_effort
from roslens.source.syntax.facts import Halstead

COUNTS = Halstead(distinct_operators=6, distinct_operands=4, operators=6, operands=8)
NOTHING = Halstead()


def test_values_worked_out_by_hand(check_example):
    check_example("halstead_effort")


def test_it_is_difficulty_times_volume():
    counts = Halstead(2, 2, 4, 4)
    assert halstead_effort.of_halstead(counts) == (2 / 2 * 4 / 2) * (8 * 2)
    assert halstead_effort.of_halstead(NOTHING) == 0
