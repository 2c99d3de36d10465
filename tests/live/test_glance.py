"""Who looks at some topics sees every state as it is, and values of these as if everything were looked at."""

from random import Random

import msgspec
import pytest
from live.test_live_tree import SECONDS, Watched, history

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.rate.glance import LEAST_LOOKS, ROUND_S
from roslens.live.rate.monitor import Monitor
from roslens.live.system.connection_name import connection_ends
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.traffic.tally import Moments, Observer, Tally
from roslens.model.verdict import State


def topic_of(entity):
    if entity.kind is EntityKind.TOPIC:
        return entity.name
    return connection_ends(entity)[0] if entity.kind is EntityKind.CONNECTION else ""


def states(view):
    """Return what stands where and how, without values."""
    below = [states(one) for one in view.children]
    return view.id, view.name, view.state, view.worst, view.counts, view.below, below


def values(view, topics):
    """Return the values of topics, their connections, and of everything that is no traffic."""
    found, waiting = {}, [view]
    while waiting:
        part = waiting.pop()
        kind, _, name = part.id.partition(":")
        traffic = name if kind == "topic" else name.split(" > ")[1] if kind == "connection" else None
        if traffic is None or traffic in topics:
            found[part.id] = part.values, part.observer
        waiting += part.children
    return found


def judged(verdicts, topics):
    """Return verdicts whole, as far as they are not fine, or of topics; what is suspended keeps what was seen last."""
    shown = (one for one in verdicts if one.state is not State.OK or topic_of(one.entity) in {"", *topics})
    return [
        msgspec.to_builtins(
            msgspec.structs.replace(one, value=None, time=0.0, evidence="") if one.state is State.SUSPENDED else one
        )
        for one in shown
    ]


def begins(watched, topic):
    """Return when windows of a topic begin: who looks while news is late lets the oldest part go a moment sooner."""
    known = watched.monitor.world.topics.get(topic)
    connections = known.all_connections() if known is not None else ()
    return {
        one.id: [window.buckets[0].start for windows in one._order for window in windows if window.buckets]
        for one in connections
    }


def stands(standing):
    return {one.key: (one.state.state, one.state.since) for one in standing}


def held(seed):
    """Hold a monitor that is looked at in part against one that is looked at as a whole; a third one never is.

    Return whether that was possible to the end.

    With clocks of hosts that jump, a look finds now and then what no tick has found yet. From then on it is no truth to
    hold anything against, and what is looked at in part stands as one of the other two does.
    """
    draw = Random(seed)
    partly, wholly, alone = three = Watched(), Watched(), Watched()
    events, now = history(draw), 0.0
    said = [[], [], []]
    while now < SECONDS + 3:
        now += draw.choice([0.05, 0.25, 0.25, 1.1])
        while events and events[0][0] <= now:
            time, _, what, value = events.pop(0)
            for one in three:
                one.take(time, what, value)
        for one, reported in zip(three, said, strict=True):
            reported += [(v.entity, v.expectation, v.state, v.since, v.cause) for v in one.monitor.tick(now)]
        if draw.random() < 0.8:
            known = sorted(partly.monitor.world.topics)
            looked_at = {name for name in known if draw.random() < 0.4} | {"/nothing"}
            found = partly.monitor.glance(now, looked_at)
            view, verdicts = wholly.monitor.tree(now), wholly.monitor.standing()
            ticked, looked, mine = (stands(one.monitor._standing()) for one in (alone, wholly, partly))
            if ticked != looked:
                assert all(stand in (ticked[key], looked[key]) for key, stand in mine.items()), f"seed {seed}"
                return False
            assert mine == looked, f"seed {seed} at {now:.2f} s"
            assert states(found.view) == states(view), f"seed {seed} at {now:.2f} s"
            alike = {topic for topic in looked_at if begins(partly, topic) == begins(wholly, topic)}
            assert values(found.view, alike) == values(view, alike), f"seed {seed} at {now:.2f} s"
            mine, whole = (
                [one for one in reported if topic_of(one.entity) not in looked_at - alike]
                for reported in (found.standing, verdicts)
            )
            assert judged(mine, alike) == judged(whole, alike), f"seed {seed} at {now:.2f} s"
            assert [(one.entity, one.expectation, one.state, one.since, one.cause) for one in found.standing] == [
                (one.entity, one.expectation, one.state, one.since, one.cause) for one in verdicts
            ]
    assert said[0] == said[1] == said[2]
    return True


def test_it_is_as_if_everything_were_looked_at():
    assert sum(held(seed) for seed in range(25)) >= 23


def test_a_clock_before_its_beginning_makes_no_silence():
    """Here an observer's clock begins at -3 s: a look took every message of it for none."""
    assert held(1699)


def test_a_tap_that_loses_messages_is_judged_without_a_look():
    """Here a look found what no tick had: a tap had lost a message, and its connection rested on."""
    assert held(1562)


def test_everything_has_its_turn_within_a_round():
    watched = Watched()
    events = history(Random(3))
    while events:
        time, _, what, value = events.pop(0)
        watched.take(time, what, value)
        watched.monitor.tick(time)
    monitor = watched.monitor
    now = monitor._clock.now
    glances = monitor._glances
    glances.turn((), now)
    turns = set()
    for step in range(1, 42):
        turns.update(one.name for one in glances._in_turn(now + step * ROUND_S / 40))
    assert turns == set(monitor.world.topics)
    few = glances._in_turn(now + 1000)
    assert len(few) <= 1 + len(monitor.world.topics) / LEAST_LOOKS


def of_a_second(topic, second):
    gaps = Moments(10, 1.0, 0.1, 0.1, 0.1)
    return Tally(
        topic, "/talker", "/listener", second, second + 1.0, 10, 1000, second + 0.05, second + 0.95, gaps,
        observer=Observer.SCRIPTED,
    )  # fmt: skip


def test_of_what_is_fine_only_what_told_something_is_judged_and_read_again():
    rules = b"kind: reference\nname: r\ndefaults: {grace: 0 s}\nconstraints:\n  - {topic: '/**', rate: '>= 5 Hz'}\n"
    monitor = Monitor(load_reference([GivenText("r.yaml", rules)], BY_KEY), start=0.0)
    for second in range(8):
        monitor.add_tallies(of_a_second(topic, float(second)) for topic in ("/a", "/b"))
        monitor.tick(second + 1.0)
    first = monitor.glance(8.0, ["/a", "/b"])
    monitor.add_tally(of_a_second("/a", 8.0))
    monitor.tick(9.25)
    turn = monitor._glances.turn(["/a", "/b"], 9.25)
    assert [[one.name for one in topics] for topics in turn] == [["/a"], ["/b"]]
    later = monitor.glance(9.25, ["/a", "/b"])
    assert [one.time for one in first.standing] == [8.0, 8.0]
    # That the other one is still fine was found out as well.
    assert [one.time for one in later.standing] == [9.25, 9.25]
    assert {one.state for one in later.standing} == {State.OK}


@pytest.mark.nightly
@pytest.mark.parametrize("hundred", range(10, 30))
def test_wide_search(hundred):
    for seed in range(100 * hundred, 100 * hundred + 100):
        held(seed)
