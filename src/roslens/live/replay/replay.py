"""A recording through the same monitor that watches live systems, as fast as it can be read."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from typing import Protocol

import msgspec

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.expectation import FieldCheck, Reference, Selector
from roslens.judge.reference.pattern_index import CompiledSelector
from roslens.live.join.session import Session, Step
from roslens.model.entity import EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Graph
from roslens.model.traffic.tally import Tally
from roslens.model.wire import VERSION, Frame

STEP_S = 0.5
"""What happens within a step is reported at its end; when it began is known better."""
SHORTEST_STEP_S = 0.1

_OF_STAMPS = frozenset({"age", "age_max"})


class RecordedTopic(Protocol):
    """The metadata of a topic in a recording."""

    @property
    def name(self) -> str:
        """Resolved name."""

    @property
    def type(self) -> str:
        """Of its messages."""

    @property
    def stamped(self) -> bool:
        """Whether its messages begin with a header."""


class Recording(Protocol):
    """What can be replayed; the bag adapter has it."""

    @property
    def topics(self) -> Sequence[RecordedTopic]:
        """The topics, by name."""

    @property
    def start(self) -> float:
        """Seconds of the first message."""

    @property
    def end(self) -> float:
        """Seconds of the last message."""

    @property
    def failures(self) -> tuple[Failure, ...]:
        """What could not be read so far."""

    @property
    def graphs(self) -> Sequence[tuple[float, Graph]]:
        """Those that were recorded, by the second of receipt."""

    def graph(self) -> Graph:
        """Return topics and publishers."""

    def tallies(self, step: float = 1.0, stamps: Collection[str] = ()) -> Iterator[tuple[float, list[Tally]]]:
        """Yield the traffic step by step."""

    def fields(self, wanted: Mapping[str, Collection[str]]) -> Iterator[tuple[float, str, dict[str, float]]]:
        """Yield fields of messages in order of receipt."""


def replay(
    recording: Recording,
    reference: Reference,
    *,
    step_s: float | None = None,
    report: Callable[[Step], None],
    begun: Callable[[Session], None] = lambda _: None,
    graphs: Sequence[tuple[float, Graph]] = (),
) -> Session:
    """Rate a recording and report each step; returns the session as it was at the end.

    Stamps and fields are read only of topics for which the reference has a constraint on them. A step is by default
    half as long as the tightest bound on gaps, or gaps shortly after one another could not be distinguished. ``begun``
    is given the session before its first step. ``graphs`` take the place of those of the recording, each from some
    seconds on, by time.

    Raises:
        UsageError: the recording does not have what it says.
    """
    session = Session(reference, start=recording.start)
    begun(session)
    changes = [*graphs] or [*recording.graphs]
    first = recording.graph() if graphs or not changes else changes.pop(0)[1]
    session.take([Frame(VERSION, "recording", 0, recording.start, graph=first)])
    fields = recording.fields(wanted_fields(reference, ((topic.name, topic.type) for topic in recording.topics)))
    waiting = next(fields, None)
    length = step_s or usual_step(reference)
    for step, tallies in recording.tallies(length, stamps=wanted_stamps(reference, recording.topics)):
        # What came after the last message is unknown: the last step ends with it.
        end = min(step, recording.end)
        tallies = (
            [msgspec.structs.replace(tally, end=min(tally.end, end)) for tally in tallies] if end < step else tallies
        )
        while waiting is not None and waiting[0] <= end:
            session.monitor.add_field(waiting[1], waiting[0], waiting[2])
            waiting = next(fields, None)
        while changes and changes[0][0] <= end:
            session.take([Frame(VERSION, "recording", 0, end, graph=changes.pop(0)[1])])
        session.take([Frame(VERSION, "recording", 0, end, tallies, looked=end)])
        report(session.look(end))
    session.take(recording.failures)
    return session


def usual_step(reference: Reference) -> float:
    """Return how many seconds of a recording are looked at together."""
    bounds = [one.range.maximum for one in reference.expectations if one.quantity == "largest_gap"]
    tightest = min((one for one in bounds if one is not None), default=2 * STEP_S)
    return min(max(round(tightest / 2, 2), SHORTEST_STEP_S), STEP_S)


def wanted_stamps(reference: Reference, topics: Iterable[RecordedTopic]) -> list[str]:
    """Return the topics whose stamps the reference asks for."""
    selectors = [one.selector for one in reference.expectations if one.quantity in _OF_STAMPS]
    chained = {topic for chain in reference.chains for topic in chain.topics}
    patterns = [Pattern.parse(one.name) for one in selectors if _of_traffic(one)]
    return sorted(
        topic.name
        for topic in topics
        if topic.stamped and (topic.name in chained or any(pattern.matches(topic.name) for pattern in patterns))
    )


def wanted_fields(reference: Reference, topics: Iterable[tuple[str, str]]) -> dict[str, list[str]]:
    """Return the paths of fields that the reference asks for, by topic that is there; of ``topics`` name and type."""
    known = sorted(set(topics))
    names = {name for name, _ in known}
    wanted: dict[str, set[str]] = {}
    for check in reference.field_checks:
        for topic, path in _fields_of(check, known):
            if topic in names:
                wanted.setdefault(topic, set()).add(path)
    return {topic: sorted(paths) for topic, paths in sorted(wanted.items())}


def _fields_of(check: FieldCheck, topics: Iterable[tuple[str, str]]) -> Iterator[tuple[str, str]]:
    """Yield the fields that a constraint looks at, as topic and path; of ``topics`` name and type."""
    selector = CompiledSelector(check.selector)
    chosen = [name for name, type_ in topics if selector.matches(name, ("", type_, "", ""))]
    for topic in chosen:
        yield topic, check.field
    for part in (check.condition, check.other):
        if part is not None:
            for topic in [part.topic] if part.topic else chosen:
                yield topic, part.field


def _of_traffic(selector: Selector) -> bool:
    return selector.kind in (EntityKind.TOPIC, EntityKind.CONNECTION)
