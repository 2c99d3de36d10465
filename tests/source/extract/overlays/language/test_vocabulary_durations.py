"""Stretches of time, as timers tell them."""

import pytest


@pytest.mark.parametrize(
    ("written", "seconds"),
    [("500ms", 0.5), ("std::chrono::seconds(2)", 2.0), ("std::chrono::microseconds(250)", 250e-6), ("1s", 1.0)],
)
def test_periods_of_rclcpp(node_of, written, seconds):
    (one,) = node_of(f"timer_ = create_wall_timer({written}, [this]() {{ work(); }});").timers
    assert one.period_s == pytest.approx(seconds)


def test_a_period_that_is_unknown(node_of):
    (one,) = node_of("timer_ = create_wall_timer(std::chrono::milliseconds(ask()), [this]() { work(); });").timers
    assert one.period_s is None
