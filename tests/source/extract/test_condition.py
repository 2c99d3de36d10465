import pytest

from roslens.source.extract.condition import negated


@pytest.mark.parametrize(
    ("condition", "opposite"),
    [("a", "not a"), ("not a", "a"), ("a and b", "not (a and b)"), ("not a or b", "not (not a or b)")],
)
def test_the_opposite_of_a_condition(condition, opposite):
    assert negated(condition) == opposite


def test_the_opposite_of_no_exception_is_one():
    assert negated("no exception") == "an exception"
