from __future__ import annotations

from roslens.source.metrics.halstead import halstead_difficulty
from roslens.source.syntax.facts import Halstead

COUNTS = Halstead(distinct_operators=6, distinct_operands=4, operators=6, operands=8)
NOTHING = Halstead()


def test_it_rises_with_the_use_of_each_operand():
    rarely = Halstead(distinct_operators=6, distinct_operands=8, operators=6, operands=8)
    assert halstead_difficulty.of_halstead(COUNTS) == 6 > halstead_difficulty.of_halstead(rarely) == 3


def test_without_operands_it_is_zero():
    assert halstead_difficulty.of_halstead(NOTHING) == halstead_difficulty.of_halstead(Halstead(2, 0, 3, 0)) == 0
