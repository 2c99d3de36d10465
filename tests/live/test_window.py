"""A window takes what follows by a shorter way, and holds the same afterwards."""

from __future__ import annotations

from random import Random

import msgspec
import pytest
from live.random_traffic import of

from roslens.live.window.round import Round
from roslens.live.window.window import Window
from roslens.model.traffic.tally import NOTHING, Observer, Tally
from roslens.model.traffic.tally_columns import row_of


def following(draw: Random, many: int):
    """Yield tallies that follow each other, and rounds, as a connection with an envelope gets them."""
    until, spacing, last = draw.choice([0.0, 100.0, 1e9]), 0.2, 0.0
    usual = draw.choice([0.02, 0.1, 0.2, 0.5])
    holes, sizes, reported = draw.random() < 0.5, draw.choice([0.0, 0.0, 0.3]), draw.choice([0.0, 0.5, 1.0])
    slow = draw.choice([1, 1, 8])
    for number in range(many):
        hole = draw.choice([0.0, 0.0, -5e-7, 0.5 * spacing, 0.99 * spacing]) if holes else 0.0
        start = until + hole
        end = start + usual * draw.choice([1.0, 1.0, 0.3, 1.7])
        count = draw.randint(1, 5)
        step = (end - start) / count
        first, last_before, last = start + step * draw.random(), last, end - step * draw.random() * 0.9
        last = max(first, last)
        gaps = [slow * step * draw.uniform(0.5, 2) for _ in range(count)]
        some = [draw.random() for _ in range(draw.choice([0, count]))]
        yield Tally(
            "/a", "/p", "/s", start, end, count, -1 if draw.random() < sizes else draw.randint(0, 999),
            first if draw.random() > 0.02 else 0.0, last if draw.random() > 0.02 else 0.0, of(gaps), of(some),
            of(some) if draw.random() < 0.2 else NOTHING, draw.choice([-1, 0, 2]), Observer.INSIDE, "", of(some),
            last_before if draw.random() < reported else 0.0,
        )  # fmt: skip
        spacing = max(end - until, 0.9 * spacing)
        until = end
        if draw.random() < 0.4:
            ended = Round()
            ended.time = number / 10
            yield ended


def held(window: Window):
    """Return everything that a window knows."""
    known = {name: getattr(window, name) for name in Window.__slots__ if name not in ("buckets", "_strange", "cache")}
    buckets = []
    for bucket in window.buckets:
        fields = msgspec.structs.asdict(bucket)
        series = ("period", "latency", "age", "processing")
        fields |= {name: tuple(getattr(fields[name], one) for one in NOTHING.__struct_fields__) for name in series}
        buckets.append(fields)
    return known, buckets


@pytest.mark.parametrize("seed", range(200))
def test_both_ways_lead_to_the_same(seed):
    draw = Random(seed)
    length, most = draw.choice([0.0, 0.3, 2.0, 10.0]), draw.choice([4, 20, 20, 200])
    (one, other) = (Window(Observer.INSIDE, "", length, most) for _ in range(2))
    records = list(following(draw, 120))
    for window in (one, other):
        window.add(records[0], 0.0)
    for record in records[1:]:
        if isinstance(record, Round):
            one.notice(record.time)
            other.notice(record.time)
            continue
        length, hole = record.end - one.until, record.start - one.until
        one.follow(record, length, hole)
        other.follow_row(row_of(record), length, hole)
        assert held(one) == held(other)
        if draw.random() < 0.05:
            now = one.noticed + draw.choice([0.0, 0.1])
            one.settle(now)
            other.settle(now)
