"""The switch's sums, without a network."""

import json
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from testbed.switch import QUEUE_SECONDS, Egress, Switch


def egress(**settings: float) -> Egress:
    made = Egress(random.Random(1))
    made.change(settings)
    return made


def test_nothing_set_means_at_once():
    assert egress().due(1500, 7.0) == 7.0


def test_a_delay_is_added():
    assert egress(delay_ms=20).due(1500, 7.0) == pytest.approx(7.020)


def test_a_rate_lets_frames_wait_for_each_other():
    link = egress(rate_bit=12_000)  # a frame of 150 bytes takes 0.1 s
    assert [link.due(150, 0.0) for _ in range(3)] == pytest.approx([0.1, 0.2, 0.3])
    assert link.due(150, 5.0) == pytest.approx(5.1)


def test_a_full_queue_drops():
    link = egress(rate_bit=12_000)
    passed = [link.due(150, 0.0) is not None for _ in range(20)]
    assert sum(passed) == QUEUE_SECONDS / 0.1 + 1
    assert link.state()["overrun"] == 20 - sum(passed)


def test_loss_is_the_share_asked_for():
    link = egress(loss_percent=20)
    lost = sum(link.due(100, float(n)) is None for n in range(10_000))
    assert lost == pytest.approx(2000, abs=120)  # three standard deviations of 40
    assert link.state()["lost"] == lost


@given(st.lists(st.floats(0, 0.05), min_size=2, max_size=50), st.floats(0, 50), st.floats(0, 50))
def test_frames_keep_their_order_and_never_arrive_before_they_were_sent(gaps, delay, jitter):
    link = egress(delay_ms=delay, jitter_ms=jitter)
    now, times = 0.0, []
    for gap in gaps:
        now += gap
        times.append((now, link.due(100, now)))
    due = [at for _, at in times]
    assert due == sorted(due)
    assert all(at >= sent for sent, at in times)


def test_frames_may_overtake_where_that_is_asked_for():
    link = egress(delay_ms=20, jitter_ms=20, reorder=1)
    due = [link.due(100, n / 1000) for n in range(200)]
    assert due != sorted(due)


@pytest.mark.parametrize(
    ("request_", "named"),
    [
        ({"host": "attic", "delay_ms": 1}, "attic"),
        ({"host": "sensor", "dealy_ms": 1}, "dealy_ms"),
        ({"host": "sensor", "delay_ms": -1}, "-1"),
        ({"host": "sensor", "delay_ms": "much"}, "much"),
        ([1], "[1]"),
    ],
)
def test_wrong_requests_are_named_and_change_nothing(request_, named):
    switch = Switch({"sensor": 1000}, seed=1)
    before = switch.egress["sensor"].state()
    assert named in json.loads(switch.answer(json.dumps(request_).encode()))["error"]
    assert "error" in json.loads(switch.answer(b"\xff not json"))
    assert switch.egress["sensor"].state() == before


def test_settings_come_back_in_the_answer():
    switch = Switch({"sensor": 1000, "brain": 1001}, seed=1)
    hosts = json.loads(switch.answer(b'{"host": "sensor", "loss_percent": 5}'))["hosts"]
    assert (hosts["sensor"]["loss_percent"], hosts["brain"]["loss_percent"]) == (5, 0)
