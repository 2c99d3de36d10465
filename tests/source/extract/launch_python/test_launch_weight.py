import pytest

from roslens.source.extract.launch_python.launch_weight import MOST_WEIGHT, bounded
from roslens.source.extract.transfer.budget import BudgetExceededError


def test_what_people_write_is_kept():
    value = [{"a": "x" * 1000, "b": [1, None, ("c",)]}] * 100
    assert bounded(value) is value
    assert bounded(3) == 3


@pytest.mark.parametrize("step", [lambda one: [one, one], lambda one: {"a": one, "b": one}, lambda one: (one, one)])
def test_what_grows_without_bound_is_refused(step):
    value = "x"
    for _ in range(100):
        value = step(value)
    with pytest.raises(BudgetExceededError):
        bounded(value)


def test_long_texts_weigh_more():
    assert bounded("x" * MOST_WEIGHT)
    with pytest.raises(BudgetExceededError):
        bounded("x" * MOST_WEIGHT * 101)


def test_what_is_a_part_of_itself_is_refused():
    value = []
    value.append(value)
    with pytest.raises(BudgetExceededError):
        bounded(value)
