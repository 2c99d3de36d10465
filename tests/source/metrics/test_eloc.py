from __future__ import annotations

from roslens.source.metrics.size import eloc
from roslens.source.settings import CountingSettings


def test_it_is_what_the_parse_found(function_of):
    assert eloc.of_function(function_of(eloc=7), CountingSettings()) == 7
