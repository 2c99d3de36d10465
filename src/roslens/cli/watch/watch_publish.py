"""`roslens watch --diagnostics` and `--publish-statistics`: verdicts go back into ROS, through its observers."""

from __future__ import annotations

import argparse
import platform
import re
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

from roslens.live.observe.child_source import ChildSource, Publishes
from roslens.live.publish.turns import Turns
from roslens.model.acting.outgoing import OutgoingError, encode_outgoing
from roslens.model.errors import UsageError
from roslens.model.failure import Failure

if TYPE_CHECKING:
    from roslens.judge.reference.expectation import Reference
    from roslens.live.join.session import Session, Step
    from roslens.live.publish.downlink import Downlink
    from roslens.store.journals.journal_head import JournalHead

_TOPIC = re.compile(r"(/[A-Za-z][A-Za-z0-9_]*)+\Z")
_LONGEST_TOPIC = 200


def wanted(options: argparse.Namespace) -> Publishes | None:
    """Return what to publish by the options; None for nothing.

    Raises:
        UsageError: the topic is none.
    """
    topic = options.publish_statistics or ""
    if options.publish_statistics is not None and (not _TOPIC.match(topic) or len(topic) > _LONGEST_TOPIC):
        raise UsageError(f"--publish-statistics {topic!r}", expected="a resolved name such as `/roslens/rated`")
    return Publishes(options.diagnostics, topic) if options.diagnostics or topic else None


def publish_through(
    sources: Sequence[object], session: Session, reference: Callable[[], Reference], publishes: Publishes,
    journals: Callable[[], Iterable[JournalHead]] = tuple,
) -> Callable[[Step], None]:  # fmt: skip
    """Return what is called with each step, so that the observers among ``sources`` publish it.

    Args:
        sources: observers.
        session: what is published.
        reference: returns what it is held against now.
        publishes: what there is to publish.
        journals: returns where journals of this host end.

    Raises:
        UsageError: there is no observer of ROS.
    """
    lines = _downlinks(sources)
    if not lines:
        option = "--diagnostics" if publishes.diagnostics else "--publish-statistics"
        raise UsageError(
            f"{option} where no ROS is observed", expected="--ros1 or --ros2", advice="It publishes in what it observes"
        )
    turns = Turns(
        _Watched(session), reference, platform.node(), diagnostics=publishes.diagnostics, rated=bool(publishes.rated),
        journals=journals,
    )  # fmt: skip
    return _Publishing(turns, lines, session).take


def unpublished(sources: Sequence[object]) -> int:
    """Return how many messages the observers among ``sources`` should have published and did not get."""
    return sum(line.lost for line in _downlinks(sources))


def _downlinks(sources: Sequence[object]) -> list[Downlink]:
    return [source.downlink for source in sources if isinstance(source, ChildSource) and source.downlink is not None]


class _Watched:
    """A session, as what is published sees it."""

    def __init__(self, session: Session) -> None:
        self.standing = session.monitor.standing
        self.graph = session.graph
        self.readings = session.readings


class _Publishing:
    def __init__(self, turns: Turns, lines: Sequence[Downlink], session: Session) -> None:
        self._turns = turns
        self._lines = lines
        self._session = session

    def take(self, step: Step) -> None:
        """Hand over what there is to publish after a step."""
        for frame in self._turns.take((*step.changes, *step.causes), step.time):
            try:
                body = encode_outgoing(frame)
            except OutgoingError as error:
                self._session.take([Failure("publish", str(error), advice="Reduce what is published", partial=True)])
                continue
            for line in self._lines:
                line.say(body)
        if any(line.lost for line in self._lines):
            what = "messages could not be published: an observer ended, or does not read them in time"
            self._session.take([Failure("publish", what, partial=True)])  # which is reported once
