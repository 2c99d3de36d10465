"""The vocabulary of stretches of time: in seconds, whatever they are written in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Unknown, Value
from roslens.source.extract.domain.kinds import first_of_kind, is_number
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_FACTORS = {"ms": 1e-3, "milliseconds": 1e-3, "us": 1e-6, "microseconds": 1e-6, "ns": 1e-9, "nanoseconds": 1e-9,
            "from_nanoseconds": 1e-9}  # fmt: skip
_NANO = 1e-9


@outer("ms", "us", "ns", "s", "std.chrono.milliseconds", "std.chrono.seconds", "std.chrono.microseconds",
       "std.chrono.nanoseconds", "std.chrono.duration", "rclcpp.Duration", "rclcpp.Duration.from_seconds",
       "rclcpp.Duration.from_nanoseconds", "ros.Duration", "ros.WallDuration", "rospy.Duration", "rclcpp.Rate",
       "ros.Rate", "rclcpp.WallRate", "std.chrono_literals.ms", "std.chrono_literals.s", quiet=True)  # fmt: skip
def duration(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A stretch of time in seconds; of seconds and nanoseconds where two are given."""
    value, more = called.argument(0), called.argument(1, default=0)
    whole = called.name.endswith("Duration")
    if not is_number(value) or (whole and not is_number(more)):
        return _of_text(value)
    seconds = value * _FACTORS.get(called.name.rpartition(".")[2], 1.0)
    return seconds + more * _NANO if whole and more and is_number(more) else seconds


@outer("rclpy.duration.Duration", "rclpy.Duration", quiet=True)
def of_rclpy(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A duration of rclpy: the sum of its keywords."""
    seconds, rest = called.keywords.get("seconds", 0), called.keywords.get("nanoseconds", 0)
    if called.arguments or not is_number(seconds) or not is_number(rest):
        return _of_text(first_of_kind((seconds, rest), Text))
    return float(seconds) + rest * _NANO


def _of_text(value: Value) -> Value:
    """Return a text that decides how long something takes; of any other value nothing is known."""
    match value:
        case Text():
            return value
    return Unknown("a duration")
