"""Values of fields of messages against the constraints of a reference."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.expectation import FieldCheck, essence
from roslens.judge.reference.pattern_index import CompiledSelector, PatternIndex
from roslens.live.standing.standing import Standing
from roslens.live.standing.verdict_state import NEVER
from roslens.live.standing.watched_field import WatchedField
from roslens.model.entity import EntityKind

MAX_FIELDS = 1000
"""Fields of a topic that are kept."""
MAX_TOPICS = 10_000
"""Topics that patterns of field checks are held against."""
_NOT_ASKED = ("", "", "", "")


class FieldChecks:
    """The last value of each field that a reference speaks of, and how the constraints about them stand.

    Attributes:
        standing: each constraint about each topic that is named or was met.
        values: the newest, by topic and path; None where it is not finite.
        met: types of the topics of which messages came.
        due: when something has to be judged without news.
    """

    def __init__(self, checks: Iterable[FieldCheck], now: float, old: FieldChecks | None = None) -> None:
        """Begin with what is expected; what ``old`` has too keeps its state."""
        self._now = now
        self._checks = tuple(checks)
        self._index = PatternIndex((one.selector, one) for one in self._checks)
        self._old = {(essence(one.check), one.topic): one for one in old.standing} if old else {}
        self.met: dict[str, frozenset[str]] = {}
        self._by_topic: dict[str, list[WatchedField]] = {}
        self._waiting: set[WatchedField] = set()
        self.standing: list[WatchedField] = []
        self.values: dict[str, dict[str, float | None]] = old.values if old else {}
        self.due = now
        for check in self._checks:
            # Of a topic that is named it is said, too, that nothing came yet.
            literal = Pattern.parse(check.topic).literal
            if literal is not None and not check.type and CompiledSelector(check.selector).matches(literal, _NOT_ASKED):
                self._watch(check, literal)
        for topic, types in old.met.items() if old else ():
            self._meet(topic, types)

    def add(self, topic: str, time: float, values: Mapping[str, float], types: Collection[str] = ()) -> bool:
        """Take values of a message, received at ``time``; those that are not finite become unknown.

        Args:
            topic: on which it came.
            time: seconds on the monitor's clock.
            values: by path of the field.
            types: of the topic, where they are known.
        """
        if not self._checks:
            return False
        if self.met.get(topic) != (known := frozenset(types)) and len(self.met) < MAX_TOPICS:
            self._meet(topic, known)
        watching = self._by_topic.get(topic)
        if not watching:
            return False
        kept = self.values.setdefault(topic, {})
        for field, value in values.items():
            if field in kept or len(kept) < MAX_FIELDS:
                kept[field] = value if math.isfinite(value) else None
        for one in watching:
            one.observe(topic, time, values, self.values)
        self._waiting.update(watching)
        return True

    def clear(self) -> None:
        """Forget all values, because time broke."""
        self.values.clear()
        for one in self.standing:
            one.clear(self._now)
        self._waiting = set(self.standing)

    def judge(self, now: float, appeared: float) -> list[Standing]:
        """Judge what has news or is due; return what changed."""
        self._now = now
        if not self._waiting and now < self.due:
            return []
        waiting = self._waiting | {one for one in self.standing if one.due <= now}
        self._waiting = set()
        changed: list[Standing] = [one for one in waiting if one.judge(now, appeared)]
        self.due = min((one.due for one in self.standing), default=NEVER)
        return changed

    def _meet(self, topic: str, types: frozenset[str]) -> None:
        """Find the constraints about a topic of which these types are known."""
        self.met[topic] = types
        known = {one.check.details.id for one in self._by_topic.get(topic, ()) if one.topic == topic}
        for type_ in types or {""}:
            for check in self._index.find(EntityKind.TOPIC, topic, type=type_):
                if check.details.id not in known:
                    known.add(check.details.id)
                    self._watch(check, topic)

    def _watch(self, check: FieldCheck, topic: str) -> None:
        watched = self._old.pop((essence(check), topic), None) or WatchedField(check, topic, self._now)
        watched.check, watched.details = check, check.details
        self.standing.append(watched)
        self._waiting.add(watched)
        for name in watched.topics:
            self._by_topic.setdefault(name, []).append(watched)
