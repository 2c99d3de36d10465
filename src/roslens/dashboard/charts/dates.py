"""Round dates along an axis of time: days, months or years at regular steps, in UTC."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime, timedelta, timezone

_DAY_S = 86_400.0
_MONTH_DAYS = 30.5
_DAYS = (1, 2, 7, 14)
_MONTHS = (1, 2, 3, 6, 12, 24, 60, 120, 240, 600, 1200)


def dates_between(first: float, last: float, *, most: int) -> list[tuple[float, str]]:
    """Return round dates between two times, in seconds since 1970, in at most ``most`` steps, each with its text.

    Steps are whole days, months or years; the text is as short as these allow: ``2021``, ``2021-03``, ``2021-03-01``.
    """
    span = (last - first) / _DAY_S
    for days in _DAYS:
        if span / days <= most:
            found = list(_days(first, last, days))
            return [(time, day_of(time)) for time in found]
    for months in _MONTHS:
        if span / (months * _MONTH_DAYS) <= most:
            texts = "%Y-%m" if months < 12 else "%Y"
            return [(one.timestamp(), one.strftime(texts)) for one in _months(first, last, months)]
    return []


def day_of(time: float) -> str:
    """Return the day of a time, in UTC."""
    return _at(time).strftime("%Y-%m-%d")


def _days(first: float, last: float, step: int) -> Iterator[float]:
    begin = _at(first).replace(hour=0, minute=0, second=0, microsecond=0) + timedelta(days=1)
    while begin.timestamp() <= last:
        yield begin.timestamp()
        begin += timedelta(days=step)


def _months(first: float, last: float, step: int) -> Iterator[datetime]:
    begin = _at(first)
    month = (begin.year * 12 + begin.month - 1) // step * step
    while (at := datetime(month // 12, month % 12 + 1, 1, tzinfo=timezone.utc)).timestamp() <= last:
        if at.timestamp() >= first:
            yield at
        month += step


def _at(time: float) -> datetime:
    return datetime.fromtimestamp(time, tz=timezone.utc)
