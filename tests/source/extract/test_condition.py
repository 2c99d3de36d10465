import pytest

from roslens.source.extract.condition import negated, under_either


@pytest.mark.parametrize(
    ("condition", "opposite"),
    [("a", "not a"), ("not a", "a"), ("a and b", "not (a and b)"), ("not a or b", "not (not a or b)")],
)
def test_the_opposite_of_a_condition(condition, opposite):
    assert negated(condition) == opposite


def test_the_opposite_of_no_exception_is_one():
    assert negated("no exception") == "an exception"


def test_what_holds_wherever_either_does():
    assert under_either(("a", "b"), ("a", "not b")) == ("a",)
    assert under_either(("a", "b"), ("a", "c")) == ("a", "b or c")
    assert under_either(("a",), ("a", "c")) == ("a",)


def test_long_conditions_are_shown_in_part():
    (one,) = under_either(("a" * 500,), ("b" * 500,))
    assert (one[:2], "… or bb" in one, one[-1]) == ("aa", True, "…")
