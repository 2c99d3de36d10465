from __future__ import annotations

from roslens.source.metrics import halstead_time
from roslens.source.syntax.facts import Halstead

COUNTS = Halstead(distinct_operators=6, distinct_operands=4, operators=6, operands=8)
NOTHING = Halstead()


def test_values_worked_out_by_hand(check_example):
    check_example("halstead_time")


def test_it_is_an_eighteenth_of_the_effort():
    assert halstead_time.of_halstead(Halstead(2, 2, 4, 4)) == 32 / 18
    assert halstead_time.of_halstead(NOTHING) == 0
