from __future__ import annotations

import pytest

from roslens.source.metrics import comment_ratio


@pytest.mark.parametrize("values", [{"loc": 0.0, "comment_lines": 5.0}, {"comment_lines": 5.0}])
def test_without_code_there_is_no_ratio(values):
    assert comment_ratio.of_values(values) is None


def test_it_is_in_per_cent_and_may_exceed_a_hundred():
    assert comment_ratio.of_values({"loc": 4.0, "comment_lines": 1.0}) == 25
    assert comment_ratio.of_values({"loc": 4.0, "comment_lines": 5.0}) == 125
