"""What takes for ever is ended after its budget, wherever it is; the next input has a budget of its own."""

import re
import threading

import pytest

from roslens.intake.held_signals import held_signals
from roslens.intake.time_budget import OverBudgetError, is_spent, time_budget


def spin() -> None:
    with time_budget(0.02):
        while True:
            pass


def test_python_that_never_ends():
    with pytest.raises(OverBudgetError, match=r"more than 0.02 s of processor time"):
        spin()
    assert not is_spent()


def test_an_expression_that_never_ends():
    with pytest.raises(OverBudgetError), time_budget(0.02):
        re.match(r"(a+)+b", "a" * 60)


def catch_and_go_on() -> None:
    with time_budget(0.02):
        while True:
            try:
                while True:
                    pass
            except OverBudgetError:
                rings.append(1)
                if len(rings) == 2:
                    raise


rings: list[int] = []


def test_a_ring_that_is_caught_on_its_way_rings_again():
    with pytest.raises(OverBudgetError):
        catch_and_go_on()
    assert len(rings) == 2


def test_what_is_over_in_time_is_left_alone():
    with time_budget(5.0):
        assert not is_spent()
    assert not is_spent()


def test_a_thread_has_a_budget_that_is_asked_for():
    seen: list[bool] = []

    def ask() -> None:
        with time_budget(0.01):
            while not is_spent():
                pass
            seen.append(True)

    thread = threading.Thread(target=ask)
    thread.start()
    thread.join(20)
    assert seen == [True]
    assert not is_spent()


def test_an_interrupt_comes_after_what_cannot_bear_it():
    import signal

    done: list[str] = []

    def interrupted() -> None:
        with held_signals() as came:
            signal.raise_signal(signal.SIGINT)
            done.append(f"{list(came)}")

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            interrupted()
        assert done == [f"{[int(signal.SIGINT)]}"]
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGINT, before)
