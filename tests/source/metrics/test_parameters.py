from __future__ import annotations

from roslens.source.metrics.complexity import parameters
from roslens.source.settings import CountingSettings


def test_it_is_what_the_parse_found(function_of):
    assert parameters.of_function(function_of(parameters=4), CountingSettings()) == 4
