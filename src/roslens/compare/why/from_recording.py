"""The steps of an answer that a recording gives: was it sent, until when, and what changed then."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.compare.why.declared import Declared, ends_named
from roslens.compare.why.fit import Placed, qos_fit, type_fit
from roslens.compare.why.of_transform import steps_of_transforms
from roslens.compare.why.question import TRANSFORM, Question, near_names
from roslens.compare.why.recorded import Recorded, RecordedTopic, upstream_of
from roslens.compare.why.time_line import Break, BreakKind
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.graph import Role

_MOST = 6
_NEAR_S = 5.0
_AT_ONCE_S = 0.5
_ON_EVENTS = frozenset({"/rosout", "/rosout_agg", "/parameter_events"})
_CHANGED = "`last good` below tells what changed then"
_HELD_S = 60.0
"""What is older than this before a break is not told as its reason, in seconds."""


def steps_of_recording(question: Question, recorded: Recorded, declared: Declared | None) -> Iterator[Step]:
    """Yield what a recording says of an entity; ``declared`` tells what the entity is made of."""
    if question.kind == "topic":
        yield from _of_topic(question, recorded, declared)
    elif question.kind == "node":
        yield from _of_node(question, recorded, declared)
    elif question.kind in (TRANSFORM, "frame"):
        yield from steps_of_transforms(question, recorded)


def _of_topic(question: Question, recorded: Recorded, declared: Declared | None) -> Iterator[Step]:
    topic = recorded.topics.get(question.name)
    if topic is None:
        near = near_names(question.name, recorded.topics)
        yield Step(
            Asks.EXISTS, StepState.UNSEEN, f"not in {recorded.title}: a recording holds what it was asked for",
            "recording", how="record it too" + (f"; recorded and named alike: {', '.join(near)}" if near else ""),
        )  # fmt: skip
        return
    yield Step(Asks.EXISTS, StepState.OK, f"recorded as {topic.type or 'no type'}", "recording")
    yield _makers(question, recorded)
    yield from _fits(question, recorded, declared)
    yield from _sent(question.name, topic, recorded, declared)


def _makers(question: Question, recorded: Recorded) -> Step:
    nodes = sorted({
        one.node for one in recorded.graph.endpoints
        if one.name == question.name and one.role is Role.PUBLISHER and one.node
    })  # fmt: skip
    if nodes:
        return Step(Asks.MADE, StepState.OK, f"{', '.join(nodes[:_MOST])} published it", "recording")
    return Step(
        Asks.MADE, StepState.UNSEEN, "the recording does not say who published it", "recording",
        how="give the workspace, or record the graph of rosgraph_monitor too",
    )  # fmt: skip


def _fits(question: Question, recorded: Recorded, declared: Declared | None) -> Iterator[Step]:
    ends = [
        Placed(one, "as recorded") for one in recorded.graph.endpoints
        if one.name == question.name and one.role in (Role.PUBLISHER, Role.SUBSCRIPTION)
    ]  # fmt: skip
    beside = ends_named(declared.configuration, "topic", question.name) if declared is not None else []
    if not any(one.endpoint.role is Role.SUBSCRIPTION for one in ends):
        ends += [
            Placed(one.one.endpoint, one.one.proof.place, bool(one.one.qos_unknown))
            for one in beside if one.role is Role.SUBSCRIPTION
        ]  # fmt: skip
    for step in (type_fit(ends, "recording"), qos_fit(ends, "recording")):
        if step is not None:
            yield step


def _sent(name: str, topic: RecordedTopic, recorded: Recorded, declared: Declared | None) -> Iterator[Step]:
    line = topic.line
    on_events = name in _ON_EVENTS or name.startswith("/events/")
    counted = f"{line.count:,} message{'s' * (line.count != 1)}"
    if on_events:
        yield Step(Asks.SENT, StepState.OK, f"{counted}, which come on events", "recording")
        return
    if not line.count:
        yield Step(
            Asks.SENT, StepState.NOT, "the recorder subscribed to it, and no message came in "
            f"{recorded.end - recorded.start:.1f} s", "recording",
            how="its publisher did not run, did not publish, or its quality of service did not fit the recorder's",
        )  # fmt: skip
        return
    if not line.rate:
        says = f"{counted}, at {recorded.clock(line.first)} after the start"
        yield Step(Asks.SENT, StepState.OK, f"{says}: too few to tell a rate", "recording")
        return
    of = f"{counted} at {line.rate:.3g} Hz, from {recorded.clock(line.first)} to {recorded.clock(line.last)}"
    if not line.breaks:
        yield Step(Asks.SENT, StepState.OK, of, "recording")
        return
    for one in line.breaks:
        yield Step(Asks.SENT, StepState.NOT, _words(one, line.usual, recorded), "recording", (of,), _CHANGED)
    yield _last_good(name, line.breaks[0], recorded, declared)


def _words(one: Break, usual: float, recorded: Recorded) -> str:
    length = one.until - one.since
    if one.kind is BreakKind.STOP:
        return (
            f"it stopped: the last message came at {recorded.clock(one.since)}, {length:.1f} s before the end of the "
            f"recording, and one came every {usual:.3g} s"
        )
    if one.kind is BreakKind.GAP:
        return (
            f"nothing came for {length:.1f} s from {recorded.clock(one.since)} on, where one came every {usual:.3g} s"
        )
    return f"from {recorded.clock(one.since)} on fewer messages came than before, to the end"


def _last_good(name: str, found: Break, recorded: Recorded, declared: Declared | None) -> Step:
    """Return what changed when a topic broke: what it is made of, nodes that ended, what they logged."""
    at = found.since
    configuration = declared.configuration if declared is not None else None
    above = upstream_of(name, recorded.graph, configuration)
    first = _first_broken(at, above, recorded)
    lines = []
    if first is not None:
        topic, since, node = first
        lines.append(f"{topic}, which {node} makes it of, broke at {recorded.clock(since)}")
    lines += [
        f"{one.node} ended between {recorded.clock(one.time - _NEAR_S)} and {recorded.clock(one.time)}"
        for one in recorded.gone if at - _NEAR_S <= one.time <= at + 2 * _NEAR_S
    ]  # fmt: skip
    lines += [
        f"{recorded.clock(one.time)} {one.node} {one.level}: {one.text}"
        for one in recorded.logs if at - _NEAR_S <= one.time <= at + _NEAR_S
    ][:_MOST]  # fmt: skip
    also = sorted(
        other for other, topic in recorded.topics.items()
        if other != name and any(abs(one.since - at) <= _AT_ONCE_S for one in topic.line.breaks)
    )  # fmt: skip
    if also:
        shown = ", ".join(also[:_MOST])
        lines.append(f"broke within {_AT_ONCE_S:g} s of it too: {shown}{' …' if len(also) > _MOST else ''}")
    path = f" --bag {recorded.path}" if recorded.path else ""
    if first is not None:
        says = f"last good at {recorded.clock(at)}; first to break was {first[0]}, at {recorded.clock(first[1])}"
        return Step(
            Asks.LAST_GOOD, StepState.NOT, says, "recording", tuple(lines), "ask for that one",
            f"roslens why {first[0]}{path}",
        )  # fmt: skip
    if lines:
        return Step(Asks.LAST_GOOD, StepState.NOT, f"last good at {recorded.clock(at)}; then changed:", "recording",
                    tuple(lines))  # fmt: skip
    advice = "look at the log of its publisher" if above else "give the workspace: it says what it is made of"
    known = "nothing that it is made of is recorded" if not above else "all that it is made of went on"
    return Step(
        Asks.LAST_GOOD, StepState.UNSEEN, f"last good at {recorded.clock(at)}; {known}, and nobody logged a warning",
        "recording", how=advice,
    )  # fmt: skip


def _first_broken(at: float, above: list[tuple[str, str]], recorded: Recorded) -> tuple[str, float, str] | None:
    """Return what broke first of what a topic is made of: its name, since when, and the node that takes it."""
    found = [
        (one.since, name, node)
        for name, node in above
        if name in recorded.topics
        for one in recorded.topics[name].line.breaks[:1]
        if at - _HELD_S <= one.since <= at + _AT_ONCE_S
    ]
    if not found:
        return None
    since, name, node = min(found)
    return name, since, node


def _of_node(question: Question, recorded: Recorded, declared: Declared | None) -> Iterator[Step]:
    there = any(one.name == question.name for one in recorded.graph.nodes)
    topics = {
        one.name for one in recorded.graph.endpoints if one.node == question.name and one.role is Role.PUBLISHER
    }  # fmt: skip
    if declared is not None:
        own = declared.configuration.graph(implicit=False).endpoints
        topics |= {one.name for one in own if one.node == question.name and one.role is Role.PUBLISHER}
    known = sorted(topics & recorded.topics.keys())
    if there:
        yield Step(Asks.EXISTS, StepState.OK, f"{recorded.title} has it", "recording")
    elif not known:
        yield Step(
            Asks.EXISTS, StepState.UNSEEN, f"{recorded.title} does not say who was there", "recording",
            how="record the graph of rosgraph_monitor too, or a topic that the node publishes",
        )  # fmt: skip
    for gone in recorded.gone:
        if gone.node == question.name:
            logs = [one for one in recorded.logs if _is_of(one.node, question.name) and one.time <= gone.time][-3:]
            lines = tuple(f"{recorded.clock(one.time)} {one.level}: {one.text}" for one in logs)
            says = f"it ended: the graph no longer has it from {recorded.clock(gone.time)} on"
            yield Step(Asks.RUNS, StepState.NOT, says, "recording", lines)
    for name in known:
        for step in _sent(name, recorded.topics[name], recorded, declared):
            yield Step(step.asks, step.state, f"{name}: {step.says}", step.of, step.evidence, step.how, step.command)


def _is_of(logged: str, node: str) -> bool:
    """Return whether the name of a logger is that of a node: ROS 2 separates its parts with dots."""
    return logged.strip("/").replace(".", "/") == node.strip("/")
