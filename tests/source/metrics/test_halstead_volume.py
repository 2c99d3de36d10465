from __future__ import annotations

from roslens.source.metrics.halstead import halstead_volume
from roslens.source.syntax.facts import Halstead

COUNTS = Halstead(distinct_operators=6, distinct_operands=4, operators=6, operands=8)
NOTHING = Halstead()


def test_one_kind_of_token_has_no_information():
    assert halstead_volume.of_halstead(Halstead(0, 1, 0, 5)) == 0
    assert halstead_volume.of_halstead(Halstead(1, 1, 5, 5)) == 10


def test_nothing_has_no_volume():
    assert halstead_volume.of_halstead(NOTHING) == 0
