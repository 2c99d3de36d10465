"""What has to be there, or must not be, and how that stands."""

from __future__ import annotations

from collections.abc import Callable

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.expectation import CONDITIONAL, Presence, PresenceMode, Selector, essence
from roslens.live.standing.process_fates import ProcessFates
from roslens.live.standing.rulebook import Facts, Rulebook, find_all
from roslens.live.standing.silent_observer import blame
from roslens.live.standing.standing import Standing
from roslens.live.standing.verdict_state import NEVER
from roslens.live.window.observer_status import ObserverStatus
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Event
from roslens.model.verdict import State

Key = tuple[EntityKind, str]
_RANGES = {
    PresenceMode.ALWAYS: ">= 1",
    PresenceMode.ANY: ">= 1",
    PresenceMode.WHILE: ">= 1",
    PresenceMode.ANY_WHILE: ">= 1",
    PresenceMode.AT_MOST_ONE: "<= 1",
    PresenceMode.NEVER: "<= 0",
}
_SHOWN = 3
_WITH_COPIES = frozenset({EntityKind.NODE, EntityKind.TOPIC, EntityKind.SERVICE, EntityKind.ACTION})
"""Several nodes may bear one name, several may serve a service or publish a topic."""


class _Watched(Standing):
    """A presence, what matches it, and what matches its condition."""

    __slots__ = ("enabling", "matching", "presence")

    def __init__(self, presence: Presence, now: float) -> None:
        name = Pattern.parse(presence.selector.name).literal or presence.selector.name
        entity = EntityId(presence.selector.kind, name)
        super().__init__(entity, presence.details, "presence", _RANGES[presence.mode], now)
        self.presence = presence
        self.matching: dict[str, tuple[str, ...]] = {}
        self.enabling: set[str] = set()

    def takes(self, facts: Facts) -> bool:
        """Whether a topic has the end that is asked for; of what no graph tells any end may be there."""
        return facts.by is None or self.presence.mode is PresenceMode.NEVER or self.presence.by in facts.by

    def raw(self) -> State:
        """Return how it stands at this moment."""
        mode, count = self.presence.mode, len(self.matching)
        if mode in CONDITIONAL and not self.enabling:
            return State.SUSPENDED
        if mode is PresenceMode.NEVER:
            return State.HIGH if count else State.OK
        if mode is PresenceMode.AT_MOST_ONE:
            return State.HIGH if self.count() > 1 else State.OK
        return State.OK if count else State.ABSENT

    def count(self) -> int:
        """Return what is compared: how many match, or how often that name is there which is there most often."""
        if self.presence.mode is not PresenceMode.AT_MOST_ONE or self.presence.selector.kind not in _WITH_COPIES:
            return len(self.matching)
        return max((max(len(copies), 1) for copies in self.matching.values()), default=0)

    def explain(self) -> str:
        """Return what matches, in words."""
        condition = self.presence.condition
        if condition is not None and not self.enabling:
            return f"{_written(condition)} is not there"
        if not self.matching:
            of_topic = self.presence.selector.kind is EntityKind.TOPIC
            end = f"no {self.presence.by.value} of " if of_topic else ""
            return f"{end}{_written(self.presence.selector)} is{'' if end else ' not'} there"
        names = sorted(self.matching)
        if self.presence.mode is PresenceMode.AT_MOST_ONE and (several := self._several()):
            return several
        more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
        return f"there: {', '.join(names[:_SHOWN])}{more}"

    def _several(self) -> str:
        """Return which names are there more than once, and where."""
        found = [(name, copies) for name, copies in sorted(self.matching.items()) if len(copies) > 1]
        more = f" and {len(found) - _SHOWN} more" if len(found) > _SHOWN else ""
        return (
            "; ".join(f"{name} is there {len(copies)} times: {', '.join(copies)}" for name, copies in found[:_SHOWN])
            + more
        )


def _written(selector: Selector) -> str:
    return f"{selector.kind.value} {selector.name}"


class Presences:
    """Which entities exist, and how the constraints about their existence stand.

    Attributes:
        fates: of the processes of nodes that are gone.
    """

    def __init__(self, rules: Rulebook, now: float, old: Presences | None = None) -> None:
        """Begin with what is expected; what ``old`` has too keeps its state, and what exists stays."""
        known: dict[Presence, _Watched] = {essence(one.presence): one for one in old.standing} if old else {}
        self._index = rules.presences
        presences = rules.single_presences
        self.standing: list[_Watched] = [known.get(essence(one)) or _Watched(one, now) for one in presences]
        for watched, presence in zip(self.standing, presences, strict=True):
            watched.presence, watched.details = presence, presence.details
        self._by_presence = {one.presence: one for one in self.standing}
        self._existing: dict[Key, Facts] = {}
        self._hits: dict[Key, list[tuple[_Watched, bool]]] = {}
        self._waiting = set(self.standing)
        self.due = now
        self.fates: ProcessFates = old.fates if old else ProcessFates()
        for one in self.standing:
            one.matching.clear()
            one.enabling.clear()
        for key, facts in old.existing.items() if old else ():
            self.appear(key, facts)

    @property
    def existing(self) -> dict[Key, Facts]:
        """Everything that exists."""
        return self._existing

    def appear(self, key: Key, facts: Facts) -> None:
        """Note that an entity exists, or what else became known of it."""
        if self._existing.get(key) == facts:
            return
        self.vanish(key)
        self._existing[key] = facts
        if not self.standing:
            return
        hits = [(self._by_presence[one], condition) for one, condition in find_all(self._index, *key, facts)]
        if hits:
            self._hits[key] = hits
        for watched, condition in hits:
            if condition:
                watched.enabling.add(key[1])
            elif watched.takes(facts):
                watched.matching[key[1]] = facts.copies
            self._waiting.add(watched)

    def vanish(self, key: Key) -> None:
        """Note that an entity exists no more."""
        self._existing.pop(key, None)
        for watched, condition in self._hits.pop(key, ()):
            if condition:
                watched.enabling.discard(key[1])
            else:
                watched.matching.pop(key[1], None)
            self._waiting.add(watched)

    def judge(
        self, now: float, appeared: float, vanished: dict[Key, float],
        silent_observer: Callable[[Presence], ObserverStatus | None] = lambda _: None,
    ) -> list[Standing]:  # fmt: skip
        """Judge what has news or is due; return what changed.

        Args:
            now: seconds on the monitor's clock.
            appeared: from when grace counts.
            vanished: when entities that are gone went.
            silent_observer: the silent observer without which it is unknown whether something is there.
        """
        if not self._waiting and now < self.due:
            return []
        waiting = self._waiting | {one for one in self.standing if one.state.due <= now}
        self._waiting = set()
        changed: list[Standing] = []
        for one in waiting:
            silent = silent_observer(one.presence)
            if silent is not None:
                blame(one, silent)
                if one.state.step(now, State.UNKNOWN, None):
                    changed.append(one)
                continue
            one.evidence, one.silent_observer = one.explain() + self._why(one), ""
            began = vanished.get((one.entity.kind, one.entity.name), now)
            grace = appeared + one.details.timing.grace
            if one.state.step(now, one.raw(), float(one.count()), began=began, grace=grace):
                changed.append(one)
        self.due = min((one.state.due for one in self.standing), default=NEVER)
        return changed

    def happened(self, event: Event, entity: EntityId) -> None:
        """Take an event about an entity: where it tells how a process ended, what is absent is explained anew."""
        if self.fates.happened(event, entity):
            self._waiting |= {one for one in self.standing if one.entity.kind is EntityKind.NODE and not one.matching}

    def _why(self, watched: _Watched) -> str:
        """Return why a node that is expected is not there, as far as that is known."""
        expected = watched.entity
        if watched.matching or expected.kind is not EntityKind.NODE or watched.presence.mode is PresenceMode.NEVER:
            return ""
        fate = self.fates.of(expected.name)
        return f"; {fate}" if fate else self._instead_of(expected)

    def _instead_of(self, expected: EntityId) -> str:
        """Return which node is there under the same name in another namespace."""
        own = expected.name.rpartition("/")[2]
        alike = sorted(
            name
            for kind, name in self._existing
            if kind is EntityKind.NODE and name.rpartition("/")[2] == own and (kind, name) not in self._hits
        )
        return f"; {', '.join(alike[:_SHOWN])} is there, which nothing expects" if alike else ""

    def look_again(self) -> None:
        """Judge everything in the next tick."""
        self._waiting = set(self.standing)
