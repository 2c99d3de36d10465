"""Lifecycle states of nodes and values of parameters against the constraints of a reference."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.expectation import StateCheck, StateOf, essence
from roslens.judge.reference.pattern_index import PatternIndex
from roslens.judge.reference.same_value import number_of, same_value
from roslens.live.standing.ready_constraint import Bounds
from roslens.live.standing.silent_observer import blame
from roslens.live.standing.standing import Standing
from roslens.live.standing.verdict_state import NEVER
from roslens.live.window.observer_status import ObserverStatus
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph
from roslens.model.verdict import State

MOST = 10_000
"""Entities that are judged."""
_UNREPORTED = {StateOf.LIFECYCLE: "its state is not reported", StateOf.VALUE: "its value is not reported"}


class _Watched(Standing):
    """One constraint about one node or parameter."""

    __slots__ = ("appeared", "bounds", "check", "is_")

    def __init__(self, check: StateCheck, entity: EntityId, now: float) -> None:
        super().__init__(entity, check.details, check.of.value, check.written, now)
        self.check = check
        self.bounds = (
            Bounds(check.range, check.details.timing.margin, counted=True) if check.range is not None else None
        )
        self.appeared = now
        self.is_: str | None = None

    def raw(self) -> tuple[State, float | None]:
        """Return how it stands at this moment, and its value where that is a number."""
        if not self.is_:
            self.evidence = _UNREPORTED[self.check.of]
            return State.UNKNOWN, None
        self.evidence = f"is {self.is_}"
        number = number_of(self.is_)
        if self.bounds is not None:
            return (State.ABSENT, None) if number is None else (self.bounds.state(number), number)
        return (State.OK if any(same_value(self.is_, one) for one in self.check.allowed) else State.ABSENT), number


class StateChecks:
    """What is expected of lifecycle states and parameters, and how that stands.

    Attributes:
        graph: the newest; None before the first.
        due: when something may change without any news.
    """

    def __init__(self, checks: Iterable[StateCheck], now: float, old: StateChecks | None = None) -> None:
        """Begin with what is expected; what ``old`` has too keeps its state.

        Raises:
            ValueError: a pattern of a selector is none.
        """
        self._checks = list(checks)
        self._index = PatternIndex((one.selector, one) for one in self._checks)
        known = {(essence(one.check), one.entity): one for one in old.standing} if old else {}
        self._known = known
        self._standing: dict[tuple[str, EntityId], _Watched] = {}
        self._waiting: set[_Watched] = set()
        self.graph: Graph | None = None
        for check in self._checks:
            literal = Pattern.parse(check.selector.name).literal
            if literal is not None:
                self._watch(check, EntityId(check.selector.kind, literal), now)
        if old is not None and old.graph is not None:
            self.take(old.graph, now)
        self.due = now

    @property
    def standing(self) -> list[_Watched]:
        """Everything that is judged."""
        return list(self._standing.values())

    def take(self, graph: Graph, now: float) -> None:
        """Take the states in a graph."""
        self.graph = graph
        if not self._checks:
            return
        reported = dict(_reported(graph))
        hosts = {node.name: node.host for node in graph.nodes}
        for entity in reported:
            node = entity.name if entity.kind is EntityKind.NODE else entity.name.rpartition("/")[0]
            for check in self._index.find(entity.kind, entity.name, host=hosts.get(node, "")):
                if len(self._standing) < MOST:
                    self._watch(check, entity, now)
        for one in self._standing.values():
            is_ = reported.get(one.entity)
            if is_ != one.is_:
                if one.is_ is None:
                    one.appeared = now
                one.is_ = is_
                self._waiting.add(one)

    def look_again(self) -> None:
        """Judge everything in the next tick."""
        self._waiting.update(self._standing.values())

    def judge(self, now: float, began: float, silent_observer: Callable[[], ObserverStatus | None]) -> list[Standing]:
        """Judge what has news or is due; return what changed. Grace counts from ``began`` on at the earliest."""
        if not self._waiting and now < self.due:
            return []
        waiting = self._waiting | {one for one in self._standing.values() if one.state.due <= now}
        self._waiting = set()
        silent = silent_observer()
        changed = [one for one in waiting if _judge(one, now, began, silent)]
        self.due = min((one.state.due for one in self._standing.values()), default=NEVER)
        return [*changed]

    def _watch(self, check: StateCheck, entity: EntityId, now: float) -> None:
        key = check.details.id, entity
        if key not in self._standing:
            one = self._known.get((essence(check), entity)) or _Watched(check, entity, now)
            one.check, one.details = check, check.details
            self._standing[key] = one
            self._waiting.add(one)


def _judge(one: _Watched, now: float, began: float, silent: ObserverStatus | None) -> bool:
    if silent is not None:
        blame(one, silent)
        return one.state.step(now, State.UNKNOWN, None)
    one.silent_observer = ""
    raw, value = one.raw()
    firm = one.bounds is None or one.bounds.firm(value, one.state.state)
    grace = max(began, one.appeared) + one.details.timing.grace
    return one.state.step(now, raw, value, firm=firm, grace=grace)


def _reported(graph: Graph) -> Iterator[tuple[EntityId, str]]:
    """Yield each managed node with its state, and each parameter with its value."""
    for node in graph.nodes:
        if node.lifecycle:
            yield EntityId(EntityKind.NODE, node.name), node.lifecycle
    for node_name, parameters in graph.parameters.items():
        for name, value in parameters.items():
            yield EntityId(EntityKind.PARAMETER, f"{node_name}/{name}"), value
