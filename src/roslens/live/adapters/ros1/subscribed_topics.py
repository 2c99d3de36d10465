"""Subscriptions of the tap: to which publishers, by patterns on topics, and how they join what nodes report."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from roslens.judge.patterns.pattern import Pattern
from roslens.live.adapters.ros1.listening import EXPECTED, Listening
from roslens.live.adapters.ros1.names import TOOL, is_observer
from roslens.live.adapters.ros1.observation import Observation
from roslens.live.adapters.ros1.slave import FRAMING
from roslens.live.adapters.ros1.statistics import TOPIC
from roslens.live.adapters.ros1.wire.stream import Source, Use
from roslens.live.reported.diagnostic_array import ArrayError, read_array
from roslens.live.reported.reported_levels import TOPIC as DIAGNOSTICS
from roslens.live.reported.reported_levels import ReportedLevels
from roslens.model.failure import Failure
from roslens.model.graph import Change, Event
from roslens.model.traffic.tally import Observer, Tally
from roslens.model.wire import Frame

SILENT_ROUNDS = 10
"""Rounds after which it is worth reporting that no node publishes statistics."""
_UNREPORTED = (
    f"no node publishes {TOPIC}, so periods and ages are unknown but where a tap reads: set the parameter "
    "/enable_statistics to true before nodes start, or start them through roslens"
)


class SubscribedTopics:
    """Adds what is received to the rounds of an observation."""

    def __init__(
        self,
        observation: Observation,
        listening: Listening,
        taps: Sequence[Pattern],
        statistics: bool,
        caller: str = "",
        *,
        reports: bool = False,
    ) -> None:
        """Listen by ``taps``, to ``statistics`` and to ``reports`` of monitors other than ourselves, ``caller``."""
        self._observation = observation
        self._listening = listening
        self._taps = taps
        self._statistics = statistics
        self._caller = caller
        self._reports = reports
        self._levels = ReportedLevels()
        self._odd: set[str] = set()
        self._rounds = 0

    def round(self, moved: frozenset[str] = frozenset()) -> Frame:
        """Return the frame of a round with what was received until then."""
        frame = self._observation.round(moved)
        if not self._taps and not self._statistics and not self._reports:
            return msgspec.structs.replace(frame, looked=frame.time)
        self._rounds += 1
        sources = list(self._sources())
        self._listening.want(sources)
        reported = any(source.use is Use.STATISTICS for source in sources)
        events = list(frame.events)
        if self._statistics and not reported and self._rounds == SILENT_ROUNDS:
            # No failure: ROS 1 as it comes publishes none, and a watch of it is not incomplete for that.
            events.append(Event(frame.time, Change.CHANGED, f"host:{frame.sender.partition('/')[0]}", _UNREPORTED))
        return self._with_received(msgspec.structs.replace(frame, events=events))

    def received(self) -> Frame:
        """Return the frame of what was received since; an empty one means silence."""
        return self._with_received(self._observation.between())

    def _with_received(self, frame: Frame) -> Frame:
        taken = self._listening.take()
        events = [event for report in taken.reports for event in self._reported(*report, taken.failures)]
        # For what was queued while we were stopped, neither the time of arrival nor the losses are known.
        tallies = taken.tallies if taken.attentive else []
        return msgspec.structs.replace(
            frame,
            events=[*frame.events, *events],
            tallies=[*frame.tallies, *(self._without_framing(tally) for tally in tallies if self._known(tally))],
            failures=[*frame.failures, *taken.failures],
            shed=frame.shed + taken.shed,
            looked=frame.time if taken.attentive else 0.0,
        )

    def _known(self, tally: Tally) -> bool:
        return not is_observer(tally.publisher) and (not self._caller or tally.publisher != self._caller)

    def _reported(self, node: str, time: float, body: bytes, failures: list[Failure]) -> list[Event]:
        try:
            return self._levels.take(node, read_array(body, cdr=False), time)
        except ArrayError as error:
            if node in self._odd:
                return []
            self._odd.add(node)
            what = f"{node} sends no diagnostics: {error}"
            failures.append(Failure(TOOL, what, EXPECTED[Use.REPORTS], entity=f"node:{node}", partial=True))
            return []

    def _without_framing(self, tally: Tally) -> Tally:
        """Take the lengths before messages off what rospy reported of itself."""
        if tally.observer is not Observer.INSIDE or tally.subscriber in self._observation.unframed or tally.bytes < 0:
            return tally
        return msgspec.structs.replace(tally, bytes=max(tally.bytes - FRAMING * tally.count, 0))

    def _sources(self) -> Iterator[Source]:
        for topic, publishers in self._observation.publishers.items():
            taps = any(pattern.matches(topic) for pattern in self._taps)
            for node, uri in publishers:
                if taps:
                    yield Source(Use.TAP, topic, node, uri)
                if self._statistics and topic == TOPIC:
                    yield Source(Use.STATISTICS, topic, node, uri)
                if self._reports and topic == DIAGNOSTICS and node != self._caller:
                    yield Source(Use.REPORTS, topic, node, uri)
