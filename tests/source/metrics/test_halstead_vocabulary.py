from __future__ import annotations

from roslens.source.metrics.halstead import halstead_vocabulary
from roslens.source.syntax.facts import Halstead

COUNTS = Halstead(distinct_operators=6, distinct_operands=4, operators=6, operands=8)
NOTHING = Halstead()


def test_it_is_all_kinds_of_tokens():
    assert halstead_vocabulary.of_halstead(COUNTS) == 10
    assert halstead_vocabulary.of_halstead(NOTHING) == 0
