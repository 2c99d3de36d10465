"""Series down-sampled in tiers: fine for what was just now, coarse for what was long ago."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

import msgspec


class Tier(msgspec.Struct, frozen=True):
    """Buckets of ``seconds`` that are kept for ``kept_s``."""

    seconds: int
    kept_s: int


TIERS = (Tier(1, 900), Tier(10, 6 * 3600), Tier(60, 7 * 86_400), Tier(600, 90 * 86_400))
"""A quarter of an hour by seconds, six hours by ten seconds, a week by minutes, ninety days by ten minutes."""


class Point(msgspec.Struct, frozen=True):
    """What a series was from ``time`` on, for the length of a bucket; seconds since the epoch."""

    time: int
    count: int
    mean: float
    least: float
    greatest: float


class _Bucket:
    __slots__ = ("begin", "count", "greatest", "least", "total")

    def __init__(self, begin: int) -> None:
        self.begin = begin
        self.count = 0
        self.total = 0.0
        self.least = math.inf
        self.greatest = -math.inf

    def add(self, value: float) -> None:
        self.count += 1
        self.total += value
        self.least = min(self.least, value)
        self.greatest = max(self.greatest, value)

    def point(self) -> Point:
        return Point(self.begin, self.count, self.total / self.count, self.least, self.greatest)


class DownSampler:
    """Turns values into points of every tier; a point is given out when its bucket is over.

    Values of a series that come late, into a bucket that is over, are left out of it and counted.
    """

    def __init__(self, tiers: Iterable[Tier] = TIERS) -> None:
        self.tiers = tuple(tiers)
        self.late = 0
        self._open: dict[tuple[str, str], list[_Bucket | None]] = {}

    def add(self, entity: str, time: float, values: Mapping[str, float]) -> Iterator[tuple[str, str, Tier, Point]]:
        """Take the values of an entity at ``time``; yields what is over by that: entity, quantity, tier, point."""
        for quantity, value in values.items():
            if math.isfinite(value):
                for tier, point in self._over_by((entity, quantity), time, value):
                    yield entity, quantity, tier, point

    def _over_by(self, series: tuple[str, str], time: float, value: float) -> list[tuple[Tier, Point]]:
        """Take a value of a series; return the points of the buckets that are over by that."""
        over: list[tuple[Tier, Point]] = []
        open_ = self._open.get(series)
        if open_ is None:
            open_ = self._open[series] = [None] * len(self.tiers)
        for place, tier in enumerate(self.tiers):
            begin = int(time // tier.seconds) * tier.seconds
            bucket = open_[place]
            if bucket is not None and begin < bucket.begin:
                self.late += place == 0
                continue
            if bucket is None or begin > bucket.begin:
                if bucket is not None:
                    over.append((tier, bucket.point()))
                bucket = open_[place] = _Bucket(begin)
            bucket.add(value)
        return over

    def rest(self) -> Iterator[tuple[str, str, Tier, Point]]:
        """Yield what is in buckets that are not over, and forget it."""
        for (entity, quantity), buckets in self._open.items():
            for tier, bucket in zip(self.tiers, buckets, strict=True):
                if bucket is not None:
                    yield entity, quantity, tier, bucket.point()
        self._open.clear()

    def forget(self, before: float) -> Iterator[tuple[str, str, Tier, Point]]:
        """Yield and forget the buckets of series of which nothing came since ``before``."""
        silent = [
            key for key, buckets in self._open.items() if all(one is None or one.begin < before for one in buckets)
        ]
        for entity, quantity in silent:
            for tier, bucket in zip(self.tiers, self._open.pop((entity, quantity)), strict=True):
                if bucket is not None:
                    yield entity, quantity, tier, bucket.point()


def tier_for(seconds: float, points: int, tiers: Iterable[Tier] = TIERS) -> Tier:
    """Return the finest tier that shows ``seconds`` in at most ``points`` points; else the coarsest."""
    ordered = list(tiers)
    return next((tier for tier in ordered if seconds / tier.seconds <= points and seconds <= tier.kept_s), ordered[-1])
