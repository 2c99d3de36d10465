"""The unit of time that the name of a variable says: ``timeout_ms``, ``periodSec``, ``loop_rate``."""

from __future__ import annotations

import re
from collections.abc import Mapping

SPOKEN: Mapping[str, str] = {
    "s": "seconds",
    "ms": "milliseconds",
    "us": "microseconds",
    "ns": "nanoseconds",
    "Hz": "hertz",
}
"""Each unit in words."""
_ENDS = re.compile(
    r"(?:_|\b)(?:(?P<ms>ms|msecs?|millis|milliseconds?|milli_?secs?)|(?P<us>us|usecs?|micros|microseconds?)"
    r"|(?P<ns>ns|nsecs?|nanos|nanosecs?|nanoseconds?)|(?P<s>s|secs?|seconds?)|(?P<Hz>hz|Hz))_?$"
    r"|[a-z](?:(?P<cms>Ms|MSec|Msecs?|Millis|MilliSecs?|Milliseconds?|MilliSeconds?)|(?P<cus>Us|USec|Micros|Microseconds?)"
    r"|(?P<cns>Ns|NSec|Nanos|Nanoseconds?)|(?P<cs>Sec|Secs|Seconds)|(?P<cHz>Hz))_?$"
)
_PER_SECOND = re.compile(
    r"(?:_|\b)(?:rate|frequency|freq|fps|RATE|FREQUENCY|FPS)_?$|[a-z](?:Rate|Frequency|Freq|Fps|FPS)_?$"
)
_OF_A_TIME = frozenset(("count", "nanoseconds", "seconds", "nanosec", "nsec", "sec"))


SLOWEST = 8.0
"""Hertz: a usual rate is at least this; fewer is as often the period, in seconds, of what is called a rate."""


def unit_of_name(name: str) -> str:
    """Return the unit in which a name ends, a key of :data:`SPOKEN`; empty where it ends in none."""
    last = re.split(r"\.|->|::", name)[-1]
    if last in _OF_A_TIME or len(last.strip("_")) <= 2:
        return ""
    match = _ENDS.search(last)
    if match is None:
        return "Hz" if _PER_SECOND.search(last) else ""
    return next(key.removeprefix("c") for key, value in match.groupdict().items() if value is not None)


def is_rate(name: str) -> bool:
    """Return whether a name ends in a word for a rate, which some use for a period, and not in a unit."""
    return unit_of_name(name) == "Hz" and not re.search("(?:hz|Hz)_?$", name)


def value_of_name(name: str, code: bytes) -> float | None:
    """Return the largest number that code gives a variable, or a parameter of its name, at first; None for none."""
    bare = re.escape(re.split(r"\.|->|::", name)[-1].strip("_").encode())
    number = rb"(?:\w+::ParameterValue\()?(\d+(?:\.\d*)?)\b"
    written = (
        rb"\b" + bare + rb"_?\s*(?::\s*\w+\s*)?(?:=|\{|\()\s*" + number,
        rb"[\"'/~.]" + bare + rb"[\"']\s*,\s*(?:[\w.>-]+\s*,\s*)?" + number,
    )
    found = [float(value) for pattern in written for value in re.findall(pattern, code)]
    return max(found, default=None)
