"""A stretch of a series in a bounded number of points, each moment as fine as it is still kept, with its gaps."""

from __future__ import annotations

import math
import sqlite3
from collections.abc import Sequence
from itertools import pairwise

import msgspec

from roslens.store.live.series import TIERS

GAP_FACTOR = 2.5
"""Points that are further apart than so many times the usual distance have nothing between them."""


class Piece(msgspec.Struct, frozen=True, array_like=True):
    """One point: from ``time`` on for ``seconds``."""

    time: int
    seconds: int
    mean: float
    least: float
    greatest: float


def pieces(connection: sqlite3.Connection, series: int, since: float, until: float, most: int) -> tuple[Piece, ...]:
    """Return a series by index look-ups alone, oldest first, in about ``most`` points.

    The finest tier that shows the stretch in so many points is used as far back as it is kept, before it coarser ones.
    """
    found: list[Piece] = []
    for tier in TIERS:
        if (until - since) / tier.seconds > most:
            continue
        end = found[0].time if found else until + 1
        first = since - tier.seconds
        if end <= first:
            break
        rows = connection.execute(
            "SELECT bucket, mean, least, greatest FROM point WHERE series = ? AND tier = ? AND bucket > ?"
            " AND bucket < ? ORDER BY bucket",
            (series, tier.seconds, int(first), end),
        )
        coarse = [Piece(bucket, tier.seconds, mean, least, greatest) for bucket, mean, least, greatest in rows]
        # One that reaches into finer points would be reported twice.
        found = [one for one in coarse if not found or one.time + one.seconds <= end] + found
    return tuple(found or _thinned(connection, series, since, until, most))


def _thinned(connection: sqlite3.Connection, series: int, since: float, until: float, most: int) -> list[Piece]:
    """Return a stretch that is longer than the coarsest tier shows in so many points."""
    for tier in reversed(TIERS):
        width = max(math.ceil((until - since) / most / tier.seconds), 1) * tier.seconds
        rows = connection.execute(
            "SELECT bucket / ? * ? AS begin, sum(mean * count) / sum(count), min(least), max(greatest) FROM point"
            " WHERE series = ? AND tier = ? AND bucket > ? AND bucket <= ? GROUP BY begin ORDER BY begin",
            (width, width, series, tier.seconds, int(since) - tier.seconds, int(until)),
        )
        if found := [Piece(begin, width, mean, least, greatest) for begin, mean, least, greatest in rows]:
            return found
    return []


def gaps(found: Sequence[Piece]) -> list[int]:
    """Return the places of pieces before which nothing was reported for longer than is usual between pieces alike."""
    distances: dict[int, list[int]] = {}
    for before, one in pairwise(found):
        distances.setdefault(one.seconds, []).append(one.time - before.time)
    usual = {seconds: sorted(every)[len(every) // 2] for seconds, every in distances.items()}
    return [
        place
        for place, (before, one) in enumerate(pairwise(found), 1)
        if one.time - before.time > GAP_FACTOR * max(usual[one.seconds], before.seconds)
    ]
