"""Judging an entity: its signals at an instant against the constraints about it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from roslens.live.standing.measured import Group, Judged
from roslens.live.standing.ready_constraint import ReadyConstraint
from roslens.live.standing.silent_observer import blame
from roslens.live.standing.verdict_state import NEVER
from roslens.live.system.connection import Connection
from roslens.live.system.sampled import Sampled
from roslens.live.system.topic import Topic
from roslens.live.window.observer_status import ObserverStatus
from roslens.live.window.signals import ENDS
from roslens.live.window.traffic import longest_gap
from roslens.live.window.window import Window
from roslens.model.verdict import State

_RATES = ("rate", "rate_received", "bandwidth", "period")
_UNSEEN_PERIODS = 2
"""A topic that never said anything, or little yet, is given so many expected periods."""


def judge_connection(connection: Connection, now: float) -> list[Judged]:
    """Judge a connection; return what changed."""
    connection.settle(now)
    connection.looked = now
    due = connection.next_due(now)
    changed: list[Judged] = []
    calm = True
    if connection.silent_observer is not None:
        connection.calm, connection.due = not connection.groups, due
        return _judge_silent(connection.groups, now, connection.silent_observer)
    alone = connection.alone
    for group in connection.groups:
        if alone is not None and group.calm and group.measure is not None and not group.percentile:
            window = alone[group.at]
            value = window.cache[group.key] = group.measure(window)
            if value is not None and group.low <= value <= group.high:
                group.value, group.window = value, window
                due = min(due, _gap_due(group, window, now))
                continue
        value, seen = connection.value(group.key, group.at, group.percentile)
        if seen is not None and connection.left:
            value, seen = None, None
            _note(group, "an end of it is gone from the graph")
        due = min(due, _judge_group(group, now, value, seen, connection.appeared, changed))
        calm = calm and group.calm
    connection.calm = calm
    connection.due = due
    return changed


def _judge_silent(groups: Iterable[Group], now: float, silent_observer: ObserverStatus) -> list[Judged]:
    """Judge what is known of nothing, because its observer is silent; return what changed."""
    changed: list[Judged] = []
    for group in groups:
        group.calm = False
        changed += [one for one in group.judged if _judge_unobserved(one, now, silent_observer)]
    return changed


def _note(group: Group, evidence: str) -> None:
    """Set the reason why there is no value for the constraints of a group."""
    for judged in group.judged:
        judged.evidence = evidence


def judge_topic(topic: Topic, now: float, *, graph_known: bool, silent: Sequence[ObserverStatus] = ()) -> list[Judged]:
    """Judge a topic by its connections; return what changed.

    ``graph_known`` is whether anybody tells who is there, ``silent`` are the observers that do not report.
    """
    due = NEVER
    for connections in topic.connections.values():
        for connection in connections:
            connection.settle(now)
            due = min(due, connection.next_due(now))
    topic.looked = now
    changed: list[Judged] = []
    views = [topic.views(at) for at in range(len(topic.lengths))]
    calm = True
    for group in topic.groups:
        value, window = topic.value(group.key, group.at, group.percentile, views[group.at])
        silent_observer = (
            _silent_observer(topic, group.key, silent, nothing=value is None and window is None) if silent else None
        )
        if silent_observer is not None:
            calm = group.calm = False
            changed += [one for one in group.judged if _judge_unobserved(one, now, silent_observer)]
            continue
        if value is None and window is None:
            calm = group.calm = False
            changed += [one for one in group.judged if _judge_unseen(topic, one, now, graph_known=graph_known)]
            due = min(due, *(one.state.due for one in group.judged))
            continue
        if window is None:
            _note(group, _ends(topic))
        due = min(due, _judge_group(group, now, value, window, topic.appeared, changed))
        calm = calm and group.calm
    topic.calm = calm
    topic.due = due
    return changed


def _silent_observer(
    topic: Topic, key: str, silent: Sequence[ObserverStatus], *, nothing: bool
) -> ObserverStatus | None:
    """Return the silent observer without which a signal is not known; who is there is what observers of graphs tell."""
    lost = topic.silent_observer(key) if key not in ENDS else None
    if lost is None and (nothing or key in ENDS):
        return next((observer_status for observer_status in silent if observer_status.of_graph), None)
    return lost


def _judge_unobserved(judged: Judged, now: float, observer_status: ObserverStatus) -> bool:
    """Judge a constraint of whose value nothing is known, because its observer is silent."""
    blame(judged, observer_status)
    return judged.state.step(now, State.UNKNOWN, None)


def judge_sampled(sampled: Sampled, now: float) -> list[Judged]:
    """Judge a host, node or process; return what changed."""
    sampled.settle(now)
    due = sampled.next_due(now)
    changed: list[Judged] = []
    for judged in sampled.judged:
        constraint = judged.constraint
        if sampled.silent_observer is not None:
            if _judge_unobserved(judged, now, sampled.silent_observer):
                changed.append(judged)
            continue
        judged.silent_observer = ""
        value = sampled.value(constraint.key, constraint.timing.window, constraint.percentile, now)
        grace = sampled.appeared + constraint.timing.grace
        raw = constraint.bounds.state(value)
        if not sampled.seen and not sampled.known and constraint.literal is not None:
            raw, judged.evidence = State.ABSENT, "never seen"
        elif value is None:
            judged.evidence = "no fresh sample"
        else:
            judged.evidence = f"sampled {max(now - sampled.noticed, 0):.1f} s ago"
        began = sampled.appeared if raw is State.ABSENT else NEVER
        firm = constraint.bounds.firm(value, judged.state.state)
        if judged.state.step(now, raw, value, firm=firm, began=began, grace=grace):
            changed.append(judged)
        due = min(due, judged.state.due)
    sampled.due = due
    return changed


def _judge_group(
    group: Group, now: float, value: float | None, window: Window | None, appeared: float, changed: list[Judged]
) -> float:
    """Judge all constraints that take a value; return when one of them may change without news."""
    due = _gap_due(group, window, now)
    if group.calm and value is not None and group.low <= value <= group.high:
        group.value, group.window = value, window
        return due
    changed += [one for one in group.judged if _step(one, now, value, window, appeared)]
    due = min(due, group.settle())
    if group.calm and value is not None:
        group.value, group.window = value, window
    return due


def _step(judged: Judged, now: float, value: float | None, window: Window | None, appeared: float) -> bool:
    constraint = judged.constraint
    judged.window, judged.silent_observer = window, ""
    if value is not None and value - value != 0:
        value = None
    raw = constraint.bounds.state(value)
    state = judged.state
    grace = appeared + constraint.timing.grace
    if raw is State.OK:
        if now < grace and window is not None and not window.filled:
            moved = state.step(now, State.UNKNOWN, value)
            state.due = min(grace, now + max(window.length - (window.horizon - window.begun), 0.05))
            return moved
        return state.step(now, raw, value, firm=constraint.bounds.firm(value, state.state))
    if window is not None and not window.filled and raw.bad and _early(constraint, window, raw):
        moved = state.step(now, State.UNKNOWN, value)
        state.due = now + max(window.length - (window.horizon - window.begun), 0.05)
        return moved
    began = _began(judged, now, raw, window)
    if raw is State.LOW and value == 0.0 and constraint.silence:
        raw = State.ABSENT
    return state.step(now, raw, value, began=began, grace=grace)


def _began(judged: Judged, now: float, raw: State, window: Window | None) -> float:
    """Return when a violation began, if the window is more precise than the time of the evaluation."""
    if window is None:
        return NEVER
    if raw is State.HIGH and judged.quantity == "largest_gap":
        return longest_gap(window, now)[1]
    if window.silent and raw is not State.UNKNOWN:
        return now - window.quiet - (window.late(now) if window.horizon > window.until else 0.0)
    return NEVER


def _early(constraint: ReadyConstraint, window: Window, raw: State) -> bool:
    """Whether what may still come before the window is filled could make a bad rate fine."""
    if constraint.key == "rate" and raw is State.HIGH:
        return window.count <= constraint.bounds.high * window.length
    if constraint.key in _RATES:
        return not constraint.period or window.quiet <= _UNSEEN_PERIODS * constraint.period
    return False


def _judge_unseen(topic: Topic, judged: Judged, now: float, *, graph_known: bool) -> bool:
    """Judge a constraint on a topic that no observer reports."""
    constraint = judged.constraint
    judged.window = None
    judged.silent_observer = ""
    grace = topic.appeared + max(constraint.timing.grace, _UNSEEN_PERIODS * constraint.period)
    there = topic.known and graph_known
    if there and topic.publishers:
        raw, judged.evidence = State.UNKNOWN, "it is published, but not observed"
    elif constraint.silence and (constraint.literal is not None or topic.connections):
        raw, judged.evidence = State.ABSENT, "it has no publisher" if there else "never seen"
    elif constraint.literal is not None and not there and not topic.connections:
        raw, judged.evidence = State.ABSENT, "never seen"
    else:
        raw, judged.evidence = State.UNKNOWN, "nothing is known of it"
    return judged.state.step(now, raw, 0.0 if raw.bad else None, began=topic.appeared, grace=grace)


def _gap_due(group: Group, window: Window | None, now: float) -> float:
    """Return when the silence that goes on breaks a bound on gaps that are longer than the window."""
    if group.key != "largest_gap" or window is None:
        return NEVER
    left = [one.constraint.bounds.high - window.quiet for one in group.judged]
    return now + min((one for one in left if one >= 0), default=NEVER) + 1e-6


def _ends(topic: Topic) -> str:
    return "by the graph" if topic.known else "by the traffic seen"
