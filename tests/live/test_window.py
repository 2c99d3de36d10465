"""A window takes what follows by a shorter way, and holds the same afterwards."""

from __future__ import annotations

from random import Random

import msgspec
import pytest
from live.random_traffic import of

from roslens.live.window.round import Round
from roslens.live.window.traffic import largest_gap, loss, rate
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
    apart = ("buckets", "_strange", "_own_gaps", "cache")
    known = {name: getattr(window, name) for name in Window.__slots__ if name not in apart}
    known["_former"] = list(window._former._before)
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


def receipts(window, count, *, every=13, period=0.1, start=100.0, observer=Observer.INSIDE):
    """Let a subscriber take every so many messages; what it missed is known a moment after each receipt."""
    shares = []
    slot, missed = 0.1, 0
    for number in range(round(count * every * period / slot)):
        begin = start + number * slot
        came = number % every == 0
        first = begin + 0.05 if came else 0.0
        lost, missed = missed, every - 1 if came and number else 0
        tally = Tally(
            "/big", "/p", "/slow", begin, begin + slot, int(came), -1, first, first, lost=lost, observer=observer
        )
        window.add(tally, begin + slot)
        window.settle(begin + slot)
        shares.append(loss(window))
    return shares


def test_the_loss_of_a_subscriber_that_takes_few_messages_is_over_ten_receipts():
    shares = receipts(Window(Observer.INSIDE, "", 1.0), 60)
    known = [share for share in shares if share is not None]
    assert min(known) > 90
    assert max(known) < 94
    assert shares[: 9 * 13] == [None] * (9 * 13), "of fewer receipts nothing is known"
    assert all(share is not None for share in shares[11 * 13 :])


def test_what_a_tap_loses_is_its_own():
    window = Window(Observer.TAP, "", 1.0)
    assert set(receipts(window, 60, every=2, observer=Observer.TAP)) == {None}
    assert rate(window) == pytest.approx(10.0, rel=0.1)
    assert largest_gap(window) is None


@pytest.mark.parametrize(("span", "shown"), [(34e-6, None), (0.3, 10.0)])
def test_a_burst_of_which_nothing_before_and_behind_is_seen_shows_no_rate(span, shown):
    window = Window(Observer.INSIDE, "", 5.0)
    end = 100.0 + span
    window.add(Tally("/a", "/p", "/s", 100.0, end, 4, 40, 100.0, end, of([span / 3] * 3)), end)
    window.settle(end)
    assert rate(window) == (pytest.approx(shown) if shown else None)


def tapped(window, came, until, *, period=0.1, start=100.0, size=10):
    """Let a tap take these of the messages that are sent each period; yield time and rate after each period."""
    last, newest = 0.0, -1
    for number in range(until):
        begin = start + number * period
        first = begin + period / 2 if number in came else 0.0
        gaps = of([first - last]) if first and last else NOTHING
        lost = number - newest - 1 if first and last else 0
        tally = Tally(
            "/image", "/camera", "", begin, begin + period, int(bool(first)), size if first else 0, first, first, gaps,
            lost=lost, observer=Observer.TAP,
        )  # fmt: skip
        if first:
            last, newest = first, number
        window.add(tally, begin + period)
        window.settle(begin + period)
        yield number, rate(window)


@pytest.mark.parametrize("missed", [range(20, 24), range(20, 30), range(20, 50)])
def test_the_rate_of_what_a_tap_takes_a_part_of_is_that_of_what_is_sent(missed):
    window = Window(Observer.TAP, "", 1.0)
    came = set(range(100)) - {*missed, *(number + 40 for number in missed)}
    rates = [hertz for number, hertz in tapped(window, came, 100) if number >= max(missed) + 1]
    known = [hertz for hertz in rates if hertz is not None]
    assert known == pytest.approx([10.0] * len(known))


def test_a_silence_after_losses_of_a_tap_counts_once_it_is_much_longer_than_they_were():
    window = Window(Observer.TAP, "", 1.0)
    came = set(range(40)) - set(range(20, 30))
    rates = dict(tapped(window, came, 120))
    assert rates[39] == pytest.approx(10.0)
    assert {rates[number] for number in range(50, 72)} == {None}
    assert largest_gap(window) == pytest.approx(8.05)
    assert {rates[number] for number in range(74, 120)} == {0.0}


def test_a_silence_of_a_tap_that_lost_nothing_counts_at_once():
    window = Window(Observer.TAP, "", 1.0)
    rates = dict(tapped(window, set(range(20)), 40))
    assert rates[31] == 0.0
    assert window.doubted_s == 0.0


def test_a_silence_of_large_messages_counts_later_as_a_tap_may_lose_a_part_of_each():
    window = Window(Observer.TAP, "", 1.0)
    rates = dict(tapped(window, set(range(20)), 120, size=3_000_000))
    assert {rates[number] for number in range(30, 78)} == {None}
    assert rates[90] == 0.0


def test_losses_of_a_tap_are_forgotten_after_a_minute_without():
    window = Window(Observer.TAP, "", 1.0)
    came = set(range(700)) - set(range(20, 30))
    assert dict(tapped(window, came, 720))[719] == 0.0
    assert window.doubted_s == 0.0
