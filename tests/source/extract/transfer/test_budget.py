import pytest

from roslens.source.extract.transfer.budget import MOST_OF_PLUGIN, Budget, BudgetExceededError


def test_so_many_steps_may_be_made_and_more_for_each_plug_in():
    budget = Budget(1)
    budget.spend()
    with pytest.raises(BudgetExceededError):
        budget.spend()
    budget.extend()
    budget.spend()
    assert (budget.steps, budget.most) == (3, 1 + MOST_OF_PLUGIN)
