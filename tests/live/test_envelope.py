"""What is not judged because of an envelope would not have changed: the same verdicts as when everything is judged."""

import math
from itertools import pairwise
from random import Random

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from live.random_traffic import of, reported
from live.time_line import reference

from roslens.live.rate import evaluator as evaluator_file
from roslens.live.rate.monitor import Monitor
from roslens.live.window.plausible_tally import plausible_tally
from roslens.live.window.round import Round
from roslens.model.traffic.tally import Moments, Observer, Tally
from roslens.model.traffic.tally_columns import row_of
from roslens.model.verdict import State
from roslens.model.wire import VERSION, Frame, decode_frame, encode_frame

QUANTITIES = {
    "rate": "15..30",
    "period": "<= 0.06",
    "largest_gap": "<= 0.12",
    "jitter": "<= 0.03",
    "bandwidth": "<= 2500",
    "message_size": "50..120",
    "latency": "<= 0.02",
    "latency_max": "<= 0.03",
    "loss": "<= 10",
}
RULES = reference(
    {
        "expect": [
            {"id": f"{kind}.{key}", "kind": kind, "name": "/**", "quantity": key, "range": range_, "grace": 0.5}
            for key, range_ in QUANTITIES.items()
            for kind in ("topic", "connection")
        ]
        + [
            {
                "id": "received",
                "kind": "topic",
                "name": "/**",
                "quantity": "rate_received",
                "range": "15..30",
                "grace": 0.5,
            }
        ]
    }
)
STEPS = (
    [20.0, 20.0, 20.0, 20.0, 25.0, 16.0, 12.0, 40.0, 0.0],
    [100, 100, 100, 115, 130, 40],
    [0.01, 0.01, 0.015, 0.025, 0.05],
    [0, 0, 0, 1, 3],
)


def traffic(steps, publisher):
    """Yield tallies of 0.2 s with these rates, sizes, latencies and losses, each rate kept for a second."""
    last = None
    for number, (hertz, size, latency, lost) in enumerate(step for step in steps for _ in range(5)):
        start, end = number * 0.2, (number + 1) * 0.2
        count = round(hertz * 0.2)
        times = [start + (place + 0.5) / hertz for place in range(count)]
        gaps = [
            b - a for a, b in zip(([last] if last is not None else []) + times, times[last is None :], strict=False)
        ]
        last = times[-1] if times else last
        yield (
            end,
            Tally(
                "/a", publisher, "/s", start, end, count, count * size, times[0] if times else 0.0,
                times[-1] if times else 0.0, of(gaps), of([latency] * count), lost=lost, observer=Observer.INSIDE,
            ),
        )  # fmt: skip


def said(streams, *, every, by_columns):
    """Return changes, and values whenever somebody looks; and how often a connection rested."""
    monitor = Monitor(RULES, start=0.0)
    records = sorted((one for stream in streams for one in stream), key=lambda one: one[0])
    reported, values, place, resting = [], [], 0, 0
    for tick in range(1, round(records[-1][0] * 10) + 20):
        now = tick / 10
        came = []
        while place < len(records) and records[place][0] <= now + 1e-9:
            came.append(records[place][1])
            place += 1
        if by_columns:
            monitor.add_frame(decode_frame(encode_frame(Frame(VERSION, "h/x", tick, now, came, looked=now))[4:]))
        else:
            for tally in came:
                monitor.add_tally(tally)
        reported += [(now, str(v.entity), v.expectation, v.state, round(v.since, 3)) for v in monitor.tick(now)]
        resting += sum(one.envelope is not None for one in monitor._world.connections.values())
        if tick % every == 0:
            values += [(now, str(v.entity), v.expectation, v.state, v.value) for v in monitor.standing()]
    return reported, values, resting


def both(streams, monkeypatch):
    known = said(streams, every=7, by_columns=True)
    assert said(streams, every=7, by_columns=False) == known
    with monkeypatch.context() as patched:
        patched.setattr(evaluator_file, "envelope_of", lambda connection, topic: None)
        everything = said(streams, every=7, by_columns=False)
    assert everything[2] == 0
    return known, everything


@pytest.mark.parametrize("seed", range(12))
def test_the_same_is_said_with_and_without(seed, monkeypatch):
    draw = Random(seed).choice
    streams = [
        list(traffic([tuple(draw(values) for values in STEPS) for _ in range(6)], f"/p{number}"))
        for number in range(1 + seed % 2)
    ]
    assert_same(*both(streams, monkeypatch))


def assert_same(known, everything):
    assert known[0] == everything[0]
    for one, other in zip(known[1], everything[1], strict=True):
        assert one == (*other[:4], other[4] if other[4] is None else pytest.approx(other[4], rel=1e-6, abs=1e-9))


@pytest.mark.parametrize("seed", range(12))
def test_unruly_traffic_is_told_of_the_same(seed, monkeypatch):
    draw = Random(seed)
    observers = draw.choice([[Observer.INSIDE], [Observer.INSIDE, Observer.TAP]])
    streams = [
        list(reported(draw, f"/p{number}", observer, 7.0))
        for number in range(draw.choice([1, 1, 2]))
        for observer in observers
    ]
    assert_same(*both(streams, monkeypatch))


def of_tap(steps):
    """Return traffic as a tap sees it that takes all but what is lost."""
    for end, tally in traffic(steps, "/p"):
        yield end, msgspec.structs.replace(tally, observer=Observer.TAP)


def rules_of(**ranges):
    """Return constraints on a topic; of what a tap loses itself no loss is known, so that one on it never rests."""
    return reference(
        {
            "expect": [
                {"id": key, "name": "/a", "quantity": key, "range": one, "grace": 0.5} for key, one in ranges.items()
            ]
        }
    )


@pytest.mark.parametrize("seed", range(12))
def test_of_what_a_tap_sees_the_same_is_said(seed, monkeypatch):
    monkeypatch.setitem(globals(), "RULES", rules_of(rate="15..30", largest_gap="<= 0.2"))
    assert_same(*both([list(reported(Random(seed), "/p", Observer.TAP, 7.0))], monkeypatch))


@pytest.mark.parametrize(
    ("key", "range_", "state"),
    [("rate", "15..30", State.HIGH), ("largest_gap", "<= 0.12", State.UNKNOWN), ("jitter", "<= 0.03", State.UNKNOWN)],
)
def test_a_tap_that_loses_messages_is_looked_at(key, range_, state, monkeypatch):
    """What it misses was sent: 20 Hz of which as many are lost are 40 Hz, and its gaps are its own."""
    monkeypatch.setitem(globals(), "RULES", rules_of(**{key: range_}))
    known, everything = both([list(of_tap([(20.0, 100, 0.01, 0)] * 5 + [(20.0, 100, 0.01, 4)] * 3))], monkeypatch)
    assert_same(known, everything)
    assert known[2] > 0
    assert [one[3] for one in known[0]][:2] == [State.OK, state]


def test_a_tap_whose_messages_grow_large_is_looked_at(monkeypatch):
    """Then it may lose whole ones, and a silence of a second shows nothing."""
    monkeypatch.setitem(globals(), "RULES", rules_of(largest_gap="<= 0.12"))
    known, everything = both([list(of_tap([(20.0, 100, 0.01, 0)] * 5 + [(20.0, 100_000, 0.01, 0)] * 3))], monkeypatch)
    assert_same(known, everything)
    assert known[2] > 0
    assert [one[3] for one in known[0]] == [State.OK, State.UNKNOWN]


def test_what_came_before_its_publisher_was_known_keeps_nothing_from_resting(monkeypatch):
    whole = list(traffic([(20.0, 100, 0.01, 0)] * 8, "/p0"))
    early = [(time, msgspec.structs.replace(tally, publisher="")) for time, tally in whole[:2]]
    known, everything = both([early, whole[2:]], monkeypatch)
    assert_same(known, everything)
    _, _, resting = both([whole], monkeypatch)[0]
    assert known[2] > resting / 2 > 0


def test_steady_traffic_rests(monkeypatch):
    (_, _, resting), _ = both([list(traffic([(20.0, 100, 0.01, 0)] * 10, "/p"))], monkeypatch)
    assert resting > 60


def slow_traffic(draw, hertz, jitter, changes=()):
    """Yield tallies of 0.15 s of about as many messages as tallies; at each of ``changes`` one message is missing."""
    times, at = [], 0.05
    while at < 15:
        if not any(abs(at - one) < 0.5 / hertz for one in changes):
            times.append(at)
        at += (1 + jitter * (draw.random() - 0.5)) / hertz
    last, place = None, 0
    for number in range(100):
        start, end = number * 0.15, (number + 1) * 0.15
        mine = []
        while place < len(times) and times[place] < end:
            mine.append(times[place])
            place += 1
        known = [*([last] if last is not None else []), *mine]
        last = mine[-1] if mine else last
        yield (
            end,
            Tally(
                "/a", "/p", "/s", start, end, len(mine), 100 * len(mine), mine[0] if mine else 0.0,
                mine[-1] if mine else 0.0, of([b - a for a, b in pairwise(known)]),
                of([0.01] * len(mine)), observer=Observer.INSIDE,
            ),
        )  # fmt: skip


SLOW = {
    "rate": "2.5..10", "largest_gap": "<= 0.45", "latency": "<= 0.02", "bandwidth": "<= 2000", "jitter": "<= 0.1",
}  # fmt: skip


@pytest.mark.parametrize("quantities", [SLOW, *({key: range_} for key, range_ in SLOW.items())], ids=str)
@pytest.mark.parametrize("changes", [(), (6.0,), (6.0, 6.2, 6.4, 6.6), (3.0, 3.4, 3.8, 9.0)])
def test_a_pause_between_messages_about_as_rare_as_tallies_is_told_of_the_same(quantities, changes, monkeypatch):
    monkeypatch.setitem(globals(), "RULES", rules_of(**quantities))
    for seed in range(3):
        for hertz in (5, 4, 7, 2):
            draw = Random(seed)
            known, everything = both([list(slow_traffic(draw, hertz, draw.choice([0.0, 0.3]), changes))], monkeypatch)
            assert_same(known, everything)
            assert hertz != 5 or changes or known[2] > 100


@pytest.mark.parametrize(("key", "range_"), [("latency", "<= 0.02"), ("rate", ">= 0.1"), ("message_size", ">= 1")])
def test_silence_is_told_of_the_same_where_nothing_bounds_it(key, range_, monkeypatch):
    monkeypatch.setitem(globals(), "RULES", rules_of(**{key: range_}))
    stream = [(end, one) for end, one in slow_traffic(Random(1), 5, 0.0) if end < 8]
    silent = [
        (end, msgspec.structs.replace(one, count=0, bytes=0, first=0.0, last=0.0, period=of([]), latency=of([])))
        for end, one in slow_traffic(Random(1), 5, 0.0)
        if end >= 8
    ]
    known, everything = both([stream + silent], monkeypatch)
    assert_same(known, everything)
    assert known[2] > 50


def test_what_never_says_anything_rests_where_nothing_is_judged_of_it():
    """Such as /rosout of a node that logs nothing."""
    monitor = Monitor(rules_of(rate="1..2"), start=0.0)
    judged = 0
    for number in range(40):
        start, end = number * 0.15, (number + 1) * 0.15
        monitor.add_tally(Tally("/other", "/p", "", start, end, 0, 0, observer=Observer.INSIDE))
        judged += bool(monitor._evaluator.waiting)
        monitor.tick(end)
    (connection,) = monitor._world.connections.values()
    assert connection.envelope is not None
    assert judged < 5


NASTY = st.one_of(st.floats(), st.sampled_from([math.nan, math.inf, -math.inf, -1.0, 0.0, 1e308]))
SERIES = st.builds(Moments, st.integers(-2, 5), NASTY, NASTY, NASTY, NASTY)


@given(
    st.one_of(
        st.tuples(st.sampled_from(["start", "end", "first", "last", "longest_at"]), NASTY),
        st.tuples(st.sampled_from(["count", "bytes", "lost"]), st.integers(-3, 9)),
        st.tuples(st.sampled_from(["period", "latency", "age", "processing"]), SERIES),
        st.tuples(
            st.just("period"), st.builds(Moments, st.just(4), st.sampled_from([0.2, math.inf]), NASTY, NASTY, NASTY)
        ),
    ),
    st.sampled_from([{"rate": "15..30"}, {"message_size": ">= 1"}, {"latency": "<= 1", "loss": "<= 50"}]),
)
def test_only_what_can_be_true_is_inside(change, quantities):
    rules = {"expect": [{"id": key, "name": "/a", "quantity": key, "range": one} for key, one in quantities.items()]}
    monitor = Monitor(reference(rules), start=0.0)
    for end, tally in list(traffic([(20.0, 100, 0.01, 0)] * 3, "/p"))[:-1]:
        monitor.add_tally(tally)
        monitor.tick(end)
    ((_, tally),) = list(traffic([(20.0, 100, 0.01, 0)] * 3, "/p"))[-1:]
    (connection,) = monitor._world.connections.values()
    assert connection.envelope is not None
    changed = msgspec.structs.replace(tally, **dict([change]))
    if connection.envelope.takes(row_of(changed), Round()):
        assert plausible_tally(changed) is changed


def test_what_follows_a_window_that_is_over_is_looked_at():
    rules = {"expect": [{"id": "rate", "name": "/a", "quantity": "rate", "range": "15..30"}]}
    monitor = Monitor(reference(rules), start=0.0)
    *before, (end, tally) = list(traffic([(20.0, 100, 0.01, 0)] * 3, "/p"))
    for until, one in before:
        monitor.add_tally(one)
        monitor.tick(until)
    (connection,) = monitor._world.connections.values()
    assert connection.envelope is not None
    # Somebody looked at the window when all in it was too old, and the frame that came then had been held up.
    windows = connection.envelope.windows
    connection.catch_up()
    for window in windows:
        window.settle(end)
        window.settle(end + 60)
        assert not window.buckets
    assert not connection.envelope.takes(row_of(tally), Round())
    monitor.add_tally(tally)
    assert all(window.buckets for window in windows)


def test_who_looks_later_than_the_last_tick_empties_windows_of_what_rests():
    rules = {"expect": [{"id": "rate", "name": "/a", "quantity": "rate", "range": "15..30"}]}
    monitor = Monitor(reference(rules), start=0.0)
    *before, (end, tally) = list(traffic([(20.0, 100, 0.01, 0)] * 3, "/p"))
    for until, one in before:
        monitor.add_tally(one)
        monitor.tick(until)
    # As a page that is asked for while the watch is held up.
    monitor.tree(end + 60)
    (connection,) = monitor._world.connections.values()
    assert connection.envelope is not None
    assert not connection.envelope.windows[0].buckets
    monitor.add_tally(tally)
    monitor.tick(end)
    assert [one.state.value for one in monitor.standing()] == ["ok"]
