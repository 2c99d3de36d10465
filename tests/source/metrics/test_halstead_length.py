from __future__ import annotations

from roslens.source.metrics.halstead import halstead_length
from roslens.source.syntax.facts import Halstead

COUNTS = Halstead(distinct_operators=6, distinct_operands=4, operators=6, operands=8)
NOTHING = Halstead()


def test_it_is_all_tokens():
    assert halstead_length.of_halstead(COUNTS) == 14
    assert halstead_length.of_halstead(NOTHING) == 0
