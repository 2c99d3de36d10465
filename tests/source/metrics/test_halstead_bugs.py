from __future__ import annotations

from roslens.source.metrics import halstead_bugs
from roslens.source.syntax.facts import Halstead

COUNTS = Halstead(distinct_operators=6, distinct_operands=4, operators=6, operands=8)
NOTHING = Halstead()


def test_values_worked_out_by_hand(check_example):
    check_example("halstead_bugs")


def test_it_is_the_volume_in_another_unit():
    assert halstead_bugs.of_halstead(Halstead(2, 2, 1500, 1500)) == 2
    assert halstead_bugs.of_halstead(NOTHING) == 0
