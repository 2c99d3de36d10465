from __future__ import annotations

from roslens.source.metrics.size import physical_lines
from roslens.source.syntax.facts import Lines


def test_it_is_one_column_of_the_lines():
    assert physical_lines.of_lines(Lines(physical=10, code=5, comment=3, blank=2)) == 10
