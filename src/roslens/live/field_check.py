"""Values of fields of messages against what a reference says of them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from roslens.judge.expectation import FieldCheck, essence
from roslens.live.sentence import Bounds
from roslens.live.standing import Standing
from roslens.live.verdict_state import NEVER
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State

MAX_FIELDS = 1000
"""Fields of a topic that are kept."""


class _Watched(Standing):
    __slots__ = ("bounds", "check")

    def __init__(self, check: FieldCheck, now: float) -> None:
        entity = EntityId(EntityKind.TOPIC, check.topic)
        super().__init__(entity, check.told, check.field, check.written or str(check.range), now)
        self.check = check
        self.bounds = Bounds(check.range, check.told.timing.margin)


class FieldChecks:
    """The last value of each field that a reference speaks of, and how the sentences about them stand."""

    def __init__(self, checks: Iterable[FieldCheck], now: float, old: FieldChecks | None = None) -> None:
        """Begin with what is expected; what ``old`` has too keeps its state."""
        known: dict[FieldCheck, _Watched] = {essence(one.check): one for one in old.standing} if old else {}
        self.standing: list[_Watched] = []
        for check in checks:
            watched = known.get(essence(check)) or _Watched(check, now)
            watched.check, watched.told = check, check.told
            self.standing.append(watched)
        self.values: dict[str, dict[str, float | None]] = old.values if old else {}
        self._by_topic: dict[str, list[_Watched]] = {}
        for one in self.standing:
            topics = {one.check.topic} | ({one.check.condition.topic} if one.check.condition else set())
            for topic in topics:
                self._by_topic.setdefault(topic, []).append(one)
        self._waiting = set(self.standing)
        self.due = now

    def add(self, topic: str, values: Mapping[str, float]) -> bool:
        """Take values of the last message; those that are not finite become unknown."""
        if topic not in self._by_topic:
            return False
        kept = self.values.setdefault(topic, {})
        for field, value in values.items():
            if field in kept or len(kept) < MAX_FIELDS:
                kept[field] = value if math.isfinite(value) else None
        self._waiting.update(self._by_topic[topic])
        return True

    def clear(self) -> None:
        """Forget all values, because time broke."""
        self.values.clear()
        self._waiting = set(self.standing)

    def judge(self, now: float, appeared: float) -> list[Standing]:
        """Judge what has news or is due; return what changed."""
        if not self._waiting and now < self.due:
            return []
        waiting = self._waiting | {one for one in self.standing if one.state.due <= now}
        self._waiting = set()
        changed: list[Standing] = [one for one in waiting if self._judge(one, now, appeared)]
        self.due = min((one.state.due for one in self.standing), default=NEVER)
        return changed

    def _judge(self, one: _Watched, now: float, appeared: float) -> bool:
        condition = one.check.condition
        value = self.values.get(one.check.topic, {}).get(one.check.field)
        raw = one.bounds.state(value)
        one.evidence = "no message with this field yet" if value is None else "last message"
        if condition is not None:
            enabling = self.values.get(condition.topic, {}).get(condition.field)
            said = f"{condition.field} of {condition.topic} is {'unknown' if enabling is None else enabling}"
            if enabling is None:
                raw, one.evidence = State.UNKNOWN, said
            elif enabling not in condition.range:
                raw, one.evidence = State.SUSPENDED, f"{said}, its condition is {condition.range}"
        firm = one.bounds.firm(value, one.state.state)
        return one.state.step(now, raw, value, firm=firm, grace=appeared + one.told.timing.grace)
