"""A state follows what is measured, but not at once."""

from __future__ import annotations

import pytest

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import Timing
from roslens.live.standing.ready_constraint import Bounds
from roslens.live.standing.verdict_state import NEVER, VerdictState
from roslens.model.verdict import State


def test_a_fault_that_gets_worse_is_the_same_fault():
    state = VerdictState(Timing(), 0.0)
    state.step(1, State.LOW, 5.0, began=0.4)
    assert state.step(2, State.ABSENT, 0.0, began=1.5)
    assert (state.state, state.since) == (State.ABSENT, 0.4)
    assert state.step(3, State.HIGH, 99.0)
    assert (state.state, state.since) == (State.HIGH, 3)


def test_a_short_fault_never_counts():
    state = VerdictState(Timing(lasting=2), 0.0)
    state.step(0, State.OK, 1.0)
    for time, raw in ((1, State.LOW), (2, State.OK), (3, State.LOW), (4.5, State.OK)):
        assert not state.step(time, raw, 1.0)
    assert state.due == NEVER


def test_what_it_waits_for_is_due():
    state = VerdictState(Timing(lasting=2, recovering=3), 0.0)
    state.step(1, State.LOW, 1.0)
    assert state.due == 3
    state.step(3, State.LOW, 1.0)
    state.step(4, State.OK, 1.0)
    assert (state.state, state.due) == (State.LOW, 7)
    state.step(5, State.LOW, 1.0, grace=9)
    assert (state.state, state.due) == (State.UNKNOWN, 9)


def test_only_a_firm_value_ends_an_alarm():
    state = VerdictState(Timing(), 0.0)
    state.step(1, State.HIGH, 9.0)
    assert not state.step(2, State.OK, 4.9, firm=False)
    assert state.step(3, State.OK, 1.0, firm=True)


def test_what_is_unknown_is_no_alarm():
    state = VerdictState(Timing(), 0.0)
    state.step(1, State.HIGH, 9.0)
    assert state.step(2, State.UNKNOWN, None)
    assert state.value is None


@pytest.mark.parametrize(
    ("limits", "counted", "value"),
    [("1..1", False, 1.0), ("9.9..10.1", False, 10.0), ("<= 1", True, 1.0), ("3..4", True, 4.0)],
)
def test_a_healthy_value_is_firm_whatever_the_margin(limits, counted, value):
    bounds = Bounds(Range.parse(limits), 0.05, counted=counted)
    assert bounds.firm(value, State.HIGH)
    assert counted or bounds.firm(value, State.LOW)


def test_what_stays_inside_at_its_bound_recovers_at_last():
    state = VerdictState(Timing(), 0.0)
    state.step(1, State.HIGH, 9.0)
    assert not state.step(2, State.OK, 5.0, firm=False)
    assert state.due == 62
    state.step(30, State.HIGH, 9.0)
    assert not state.step(31, State.OK, 5.0, firm=False)
    assert not state.step(90, State.OK, 5.0, firm=False)
    assert state.step(91, State.OK, 5.0, firm=False)
    assert (state.state, state.since) == (State.OK, 31)
