import pytest

from roslens.live.adapters.ros1.budget import BURST_S, Budget, Limits


def test_what_fits_is_never_paused():
    budget = Budget(Limits(cpu=0.05), 0.0)
    assert not any(budget.spend(0.0049, 400, 1000, second / 10) for second in range(1, 1000))


@pytest.mark.parametrize(("cpu", "messages", "size"), [(0.02, 0, 0), (0, 2000, 0), (0, 0, 20_000_000)])
def test_what_costs_too_much_is_watched_a_share_of_the_time(cpu, messages, size):
    budget = Budget(Limits(0.05, 5000, 50e6), 0.0)
    running = 0
    for tenth in range(1, 6001):
        on = not budget.paused
        running += on
        budget.spend(cpu * on, messages * on, size * on, tenth / 10)
    assert running / 6000 == pytest.approx(0.25, abs=0.03)
    assert "are allowed" in budget.why


def test_a_pause_lasts_until_there_is_something_to_spend():
    budget = Budget(Limits(cpu=0.1), 0.0)
    assert budget.spend(0.1 * BURST_S + 0.01, 1, 1, 0.0)
    assert budget.spend(0.0, 0, 0, 1.0)
    assert not budget.spend(0.0, 0, 0, 3.0)
