"""What is looked at: all connections of a topic or none rest, silence ends a rest, and a look changes nothing."""

from __future__ import annotations

import pytest
from live.time_line import reference, tallies

from roslens.live.join.session import Session
from roslens.live.rate.monitor import Monitor
from roslens.model.verdict import State
from roslens.model.wire import VERSION, Frame

RATE = {"id": "rate", "name": "/scan", "quantity": "rate", "range": "15..30", "grace": 0.5}
LONG = {"id": "long", "name": "/scan", "quantity": "rate", "range": "1..30", "window": 6, "grace": 0.5}


def play(monitor, rows, until, begin=0.0):
    records = sorted((one for row in rows for one in tallies(row)), key=lambda one: one[0])
    for step in range(round(begin * 10) + 1, round(until * 10) + 1):
        for at, tally in records:
            if (step - 1) / 10 < at - 1e-9 <= step / 10:
                monitor.add_tally(tally)
        monitor.tick(step / 10)


def resting(monitor):
    return [one.envelope is not None for one in monitor._world.connections.values()]


def row(**more):
    return {"topic": "/scan", "from": 0, "to": 5, "hz": 20, **more}


def test_steady_traffic_rests_and_silence_ends_that():
    monitor = Monitor(reference({"expect": [RATE]}), start=0.0)
    play(monitor, [row()], 5.0)
    assert resting(monitor) == [True]
    play(monitor, [], 6.5, begin=5.0)
    assert resting(monitor) == [False]
    assert [one.state for one in monitor.standing()] == [State.ABSENT]
    play(monitor, [row(**{"from": 6.4, "to": 9})], 9.0, begin=6.5)
    assert [one.state for one in monitor.standing()] == [State.OK]
    assert resting(monitor) == [True]


def test_connections_of_a_judged_topic_rest_together():
    rules = reference({"expect": [RATE, {**RATE, "id": "late", "quantity": "latency", "range": "<= 1"}]})
    rows = [row(subscriber="/a", latency=0.1), row(subscriber="/b", latency=0.1)]
    monitor = Monitor(rules, start=0.0)
    play(monitor, rows, 5.0)
    assert resting(monitor) == [True, True]
    late = {"from": 5, "to": 5.4, "latency": 3.0}
    play(monitor, [row(**late, subscriber="/a"), row(**{**late, "latency": 0.1}, subscriber="/b")], 5.4, begin=5.0)
    assert resting(monitor) == [False, False]


@pytest.mark.parametrize("every", [1, 3])
def test_who_looks_sees_the_present_and_changes_nothing(every):
    rules = reference({"expect": [RATE]})
    watched, alone = Monitor(rules, start=0.0), Monitor(rules, start=0.0)
    for at, tally in tallies(row(to=4)):
        for monitor in (watched, alone):
            monitor.add_tally(tally)
            monitor.tick(at)
        if round(at * 5) % every == 0:
            (verdict,) = watched.standing()
            assert verdict.time == at
    assert watched.standing() == alone.standing()


def test_a_late_tally_after_a_silence_breaks_nothing():
    monitor = Monitor(reference({"expect": [RATE, LONG]}), start=0.0)
    records = [tally for _, tally in tallies(row(to=3))]
    late = records.pop(7)
    for tally in records:
        monitor.add_tally(tally)
        monitor.tick(tally.end)
    for step in range(31, 50):
        monitor.tick(step / 10)
    monitor.add_tally(late)
    monitor.tick(5.0)
    assert {one.expectation: one.state for one in monitor.standing()} == {"rate": State.ABSENT, "long": State.OK}


def test_who_looks_in_the_middle_of_a_round_has_noticed_what_came():
    first, second = (Monitor(reference({"expect": [RATE]}), start=0.0) for _ in range(2))
    (_, tally), *_ = tallies(row(**{"from": 5, "to": 6}))
    for monitor in (first, second):
        play(monitor, [row()], 5.0)
        assert resting(monitor) == [True]
        monitor.add_tally(tally)
    (verdict,) = first.standing()
    assert verdict.time == 5.0
    (connection,) = first._world.connections.values()
    assert connection.alone[0].until == tally.end
    for monitor in (first, second):
        monitor.tick(5.1)
    noticed = [one.quiet_since for monitor in (first, second) for one in monitor._world.connections.values()]
    assert noticed == [5.0, 5.1]


def test_what_came_is_due_at_once_though_nothing_has_to_be_judged():
    monitor = Monitor(reference({"expect": [RATE]}), start=0.0)
    play(monitor, [row()], 5.0)
    assert monitor.next_due(5.0) > 5.0
    (_, tally), *_ = tallies(row(**{"from": 5, "to": 6}))
    monitor.add_tally(tally)
    assert monitor.next_due(5.0) == 5.0


def told(session, now, *records, looked=0.0):
    session.take([Frame(VERSION, "ros2", 0, now, list(records), [], [], None, [], looked=looked)])
    session.look(now)


def test_an_observer_that_does_not_say_that_it_has_looked_is_not_looked_after_at_every_tick():
    session = Session(reference({"expect": [RATE]}), start=0.0)
    for at, tally in tallies(row()):
        told(session, at, tally)
    (connection,) = session.monitor._world.connections.values()
    looks = set()
    for step in range(51, 301):
        told(session, step / 10)
        looks.add(connection.looked)
    assert len([one for one in looks if one > 20]) <= 11
    assert [one.state for one in session.monitor.standing()] == [State.OK]
    # Within a second it is noticed that it has looked, and saw nothing.
    for step in range(301, 320):
        told(session, step / 10, looked=step / 10)
    assert [one.state for one in session.monitor.standing()] == [State.ABSENT]
