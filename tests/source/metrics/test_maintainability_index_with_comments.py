from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.source.metrics.halstead import maintainability_index, maintainability_index_with_comments


def values(comments: float, loc: float = 50.0, **more: float) -> dict[str, float]:
    return {"halstead_volume": 1000.0, "cyclomatic_complexity": 5.0, "loc": loc, "comment_lines": comments, **more}


def test_without_comments_it_is_the_plain_index():
    assert maintainability_index_with_comments.of_values(values(0.0)) == maintainability_index.of_values(values(0.0))


def test_without_code_there_is_none():
    assert maintainability_index_with_comments.of_values(values(5.0, loc=0.0)) is None


@given(st.integers(0, 500), st.integers(1, 500))
def test_more_comments_are_never_worse(comments, more):
    of_values = maintainability_index_with_comments.of_values
    assert of_values(values(float(comments), files=3.0)) <= of_values(values(float(comments + more), files=3.0)) <= 100
