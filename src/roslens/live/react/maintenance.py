"""Maintenance windows: times of the day, or stretches of time, in which nothing is done to the robot."""

from __future__ import annotations

import re
import time
from collections.abc import Sequence

import msgspec

_DAYS = ("mon", "tue", "wed", "thu", "fri", "sat", "sun")
_FORM = re.compile(r"(?:([a-z]{3})(?:-([a-z]{3}))?\s+)?(\d{1,2}):(\d{2})\s*-\s*(\d{1,2}):(\d{2})\Z")
EXPECTED = "`22:00-23:30`, `Sat 08:00-12:00` or `Mon-Fri 02:00-04:00`"
_DAY_MIN = 24 * 60


class Window(msgspec.Struct, frozen=True):
    """A stretch of some days of the week, in the local time of the host.

    Attributes:
        days: 0 is Monday; on which it begins.
        begin: minutes after midnight.
        end: the same; not after ``begin`` is on the next day.
        text: as it was written.
    """

    days: frozenset[int]
    begin: int
    end: int
    text: str


def parse_window(text: str) -> Window:
    """Read a window.

    Raises:
        ValueError: it is none; the message states what would be.
    """
    found = _FORM.match(text.strip().lower())
    if found is None:
        raise ValueError(f"{text[:60]!r} is not a maintenance window, expected {EXPECTED}")
    first, last = found[1], found[2] or found[1]
    for day in filter(None, (first, last)):
        if day not in _DAYS:
            raise ValueError(f"{day!r} in {text!r} is not a day, expected one of {', '.join(_DAYS)}")
    hours = [int(found[place]) for place in (3, 5)]
    minutes = [int(found[place]) for place in (4, 6)]
    if max(hours) > 24 or max(minutes) > 59 or any(h == 24 and m for h, m in zip(hours, minutes, strict=True)):
        raise ValueError(f"{text!r} has an invalid time, expected 00:00 to 24:00")
    days = list(range(7))
    if first:
        start, stop = _DAYS.index(first), _DAYS.index(last)
        days = [day % 7 for day in range(start, stop + 1 + (7 if stop < start else 0))]
    begin, end = (h * 60 + m for h, m in zip(hours, minutes, strict=True))
    if begin == end:
        raise ValueError(f"{text!r} is empty, expected an end after its beginning")
    return Window(frozenset(days), begin, end, text.strip())


def window_now(windows: Sequence[Window], wall_s: float) -> Window | None:
    """Return the first window that holds a time, in seconds since the epoch."""
    local = time.localtime(wall_s)
    minute = local.tm_hour * 60 + local.tm_min
    for one in windows:
        over_night = one.end <= one.begin
        end = one.end + (_DAY_MIN if over_night else 0)
        today = local.tm_wday in one.days and one.begin <= minute < end
        yesterday = over_night and (local.tm_wday - 1) % 7 in one.days and minute < one.end
        if today or yesterday:
            return one
    return None
