"""A field of the messages of one topic, and how one constraint about it stands."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping

import msgspec

from roslens.judge.reference.expectation import FieldCheck, FieldCondition, FieldMeasure
from roslens.live.standing.ready_constraint import Bounds
from roslens.live.standing.standing import Standing
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State

Values = Mapping[str, Mapping[str, float | None]]
"""The last value of fields, by topic and path; None where it is not finite."""

MOST_STRETCHES = 1000
"""Between two looks; of more, the oldest are forgotten."""


class _Stretch(msgspec.Struct):
    """Messages in a row that stand alike to the range; the worst of their values, and when they came."""

    raw: State
    value: float | None
    evidence: str
    first: float
    last: float
    excess: float


class WatchedField(Standing):
    """One field check about one topic.

    A message that breaks the range is not forgotten because the next one comes before anybody looks: where the
    constraint says no time for how long (``for``), the worst message since the last look counts, and the next look
    takes the newest; otherwise every message is judged at its time.

    Attributes:
        check: the constraint.
        topic: of the messages.
        due: when it has to be judged again without news.
    """

    __slots__ = ("_bounds", "_latest", "_previous", "_stretches", "check", "due", "topic")

    def __init__(self, check: FieldCheck, topic: str, now: float) -> None:
        self.check = check
        self.topic = topic
        self._bounds = Bounds(check.range, check.details.timing.margin)
        entity = EntityId(EntityKind.TOPIC, topic)
        super().__init__(entity, check.details, self._quantity(), check.written or str(check.range), now)
        self.evidence = "no message with this field yet"
        self.clear(now)

    @property
    def topics(self) -> frozenset[str]:
        """The topics whose messages it takes values of."""
        condition, other = self.check.condition, self.check.other
        named = {part.topic for part in (condition, other) if part is not None and part.topic}
        return frozenset({self.topic, *named})

    def clear(self, now: float) -> None:
        """Forget all values."""
        self._previous: float | None = None
        self._latest = _Stretch(State.UNKNOWN, None, "no message with this field yet", now, now, 0.0)
        self._stretches: deque[_Stretch] = deque(maxlen=MOST_STRETCHES)
        self.due = now

    def observe(self, source: str, time: float, fields: Mapping[str, float], values: Values) -> None:
        """Take a message on the topic ``source`` with ``fields``; ``values`` are the newest of all topics, with its."""
        condition = self.check.condition
        own = source == self.topic and self.check.field in fields
        enabling = condition is not None and source == (condition.topic or self.topic) and condition.field in fields
        if not own and not enabling:
            return
        value = values.get(self.topic, {}).get(self.check.field)
        measured, evidence = self._measured(value, values) if own else (self._latest.value, "last message")
        raw = self._bounds.state(measured)
        if raw is State.UNKNOWN:
            evidence = evidence if own else self._latest.evidence
        if condition is not None:
            raw, evidence = self._while(condition, values) or (raw, evidence)
        self._take(raw, measured, evidence, time)

    def _while(self, condition: FieldCondition, values: Values) -> tuple[State, str] | None:
        """Return the state and its evidence where a condition is not met or not known; None where it is met."""
        place = condition.topic or self.topic
        value = values.get(place, {}).get(condition.field)
        if value is None:
            return State.UNKNOWN, f"{condition.field} of {place} is unknown"
        if value not in condition.range:
            return State.SUSPENDED, f"{condition.field} of {place} is {value}, its condition is {condition.range}"
        return None

    def judge(self, now: float, appeared: float) -> bool:
        """Judge what came since the last look; return whether the state changed."""
        before = self.state.state
        grace = appeared + self.details.timing.grace
        if self.details.timing.lasting:
            while self._stretches:
                one = self._stretches.popleft()
                for time in (one.first, one.last):
                    self._step(one, min(max(time, self.state.time), now), grace)
            self._step(self._latest, now, grace)
            self.due = self.state.due
        else:
            worst = max(self._stretches, key=lambda one: (one.raw.bad, one.excess), default=self._latest)
            again = worst.raw.bad and self._latest.raw is not worst.raw
            one = worst if worst.raw.bad else self._latest
            self._step(one, now, grace, began=min(one.first, now))
            self._stretches.clear()
            self.due = now if again else self.state.due
        return self.state.state is not before

    def _step(self, one: _Stretch, now: float, grace: float, *, began: float = math.inf) -> None:
        self.evidence = one.evidence
        firm = self._bounds.firm(one.value, self.state.state)
        self.state.step(now, one.raw, one.value, firm=firm, began=began, grace=grace)

    def _take(self, raw: State, value: float | None, evidence: str, time: float) -> None:
        excess = 0.0
        if value is not None and raw.bad:
            excess = max(self._bounds.low - value, value - self._bounds.high)
        self._latest = _Stretch(raw, value, evidence, time, time, excess)
        last = self._stretches[-1] if self._stretches else None
        if last is None or last.raw is not raw:
            self._stretches.append(msgspec.structs.replace(self._latest))
            return
        last.last = time
        if excess >= last.excess:
            last.value, last.evidence, last.excess = value, evidence, excess

    def _measured(self, value: float | None, values: Values) -> tuple[float | None, str]:
        """Return what the range is about, and what it was made of."""
        if value is None:
            return None, "the last value is not finite"
        if self.check.measure is FieldMeasure.CHANGE:
            before, self._previous = self._previous, value
            return (
                (None, "only one message yet") if before is None else (value - before, f"from {before:g} to {value:g}")
            )
        other = self.check.other
        if self.check.measure is FieldMeasure.DIFFERENCE and other is not None:
            place = other.topic or self.topic
            against = values.get(place, {}).get(other.field)
            if against is None:
                return None, f"{other.field} of {place} is unknown"
            return value - against, f"{value:g} and {against:g}"
        return value, "last message"

    def _quantity(self) -> str:
        check = self.check
        if check.measure is FieldMeasure.CHANGE:
            return f"change of {check.field}"
        if check.measure is FieldMeasure.DIFFERENCE and check.other is not None:
            place = f"{check.other.topic} " if check.other.topic not in ("", self.topic) else ""
            return f"{check.field} - {place}{check.other.field}"
        return check.field
