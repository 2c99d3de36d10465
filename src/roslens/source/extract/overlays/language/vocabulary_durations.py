"""The vocabulary of stretches of time: in seconds, whatever they are written in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.interpreter.vocabulary import Called, outer
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
def duration(_engine: Context, _thing: Any, called: Called) -> Any:
    """A stretch of time in seconds; of seconds and nanoseconds where two are given."""
    value, more = called.argument(0), called.argument(1, default=0)
    if not _is_number(value) or (called.name.endswith("Duration") and not _is_number(more)):
        return value if isinstance(value, Text) else Unknown("a duration")
    seconds = value * _FACTORS.get(called.name.rpartition(".")[2], 1.0)
    return seconds + more * _NANO if more and called.name.endswith("Duration") else seconds


@outer("rclpy.duration.Duration", "rclpy.Duration", quiet=True)
def of_rclpy(_engine: Context, _thing: Any, called: Called) -> Any:
    """A stretch of time of rclpy, of what its keywords say together."""
    parts = [called.keywords.get("seconds", 0), called.keywords.get("nanoseconds", 0)]
    if called.arguments or not all(_is_number(one) for one in parts):
        return next((one for one in parts if isinstance(one, Text)), Unknown("a duration"))
    return float(parts[0]) + parts[1] * _NANO


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
