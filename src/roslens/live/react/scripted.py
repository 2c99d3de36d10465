"""A time line as the steps that a session would make of it."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.judge.reading.read_time_line import Given, TimeLine
from roslens.live.join.session import Step
from roslens.live.react.wellness import BEGINNING_S
from roslens.live.system.halted import Halted
from roslens.model.acting.condition import Being
from roslens.model.acting.process_end import UNKNOWN
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Process, Role
from roslens.model.verdict import State, Verdict

TICK_S = 0.1
BEFORE_S = BEGINNING_S + 1
"""A watch that has gone on for so long is past its beginning."""
_BEFALLS = {Being.RESTARTED: Change.RESTARTED, Being.FLAPPING: Change.FLAPPING}


def scripted_steps(line: TimeLine) -> Iterator[Step]:
    """Yield a step every tenth of a second; the first ones come before 0 and know nothing."""
    system = _System()
    waiting = list(line.given)
    for number in range(round(-BEFORE_S / TICK_S), round(line.until_s / TICK_S) + 1):
        now = round(number * TICK_S, 6)
        came = []
        while waiting and waiting[0].at_s <= now:
            came.append(waiting.pop(0))
        yield system.step(now, came)


class _System:
    """What is there and how it stands, so far."""

    def __init__(self) -> None:
        self._nodes: dict[str, Node] = {}
        self._others: dict[EntityId, None] = {}
        self._parameters: dict[str, dict[str, str]] = {}
        self._misfits: dict[str, bool] = {}
        self._halted: dict[EntityId, Halted] = {}
        self._pids = 0

    def step(self, now: float, came: list[Given]) -> Step:
        """Return the step in which something comes to be known."""
        verdicts = tuple(_verdict(one) for one in came if one.state is not None)
        events = tuple(event for one in came for event in self._events(one))
        changed = [self._take(one) for one in came]
        graph = self._graph() if any(changed) else None
        return Step(now, verdicts, events, graph=graph, halted=tuple(sorted(self._halted.values())))

    def _events(self, given: Given) -> Iterator[Event]:
        if given.being in _BEFALLS:
            yield Event(given.at_s, _BEFALLS[given.being], str(given.entity))
        node = self._nodes.get(given.entity.name)
        if given.being is Being.CRASHED and node is not None:
            yield _process_end(given, node, UNKNOWN)
        if given.being is Being.GONE and given.ended and node is not None:
            yield _process_end(given, node, given.ended)
        if given.being in (Being.GONE, Being.CRASHED):
            yield Event(given.at_s, Change.VANISHED, str(given.entity))

    def _take(self, given: Given) -> bool:
        """Take what is given of the graph; return whether that changed."""
        entity, being = given.entity, given.being
        if being in (Being.STOPPED, Being.HUNG):
            self._halted[entity] = Halted(entity, being is Being.HUNG, given.at_s)
        elif being is not None:
            self._halted.pop(entity, None)
        if being is None and not given.lifecycle and given.value is None:
            return False
        if being in (Being.GONE, Being.CRASHED):
            self._nodes.pop(entity.name, None) if entity.kind is EntityKind.NODE else self._others.pop(entity, None)
            self._misfits.pop(entity.name, None)
        elif given.value is not None:
            node, _, name = entity.name.rpartition("/")
            self._parameters.setdefault(node, {})[name] = given.value
        elif entity.kind is EntityKind.NODE:
            self._take_node(given)
        elif entity.kind is EntityKind.TOPIC:
            self._misfits[entity.name] = being is Being.MISFIT
        else:
            self._others[entity] = None
        return True

    def _take_node(self, given: Given) -> None:
        """Take a node that is there: what is not given of it is as before."""
        name = given.entity.name
        before = self._nodes.get(name)
        if before is None:
            self._pids += 1
            before = Node(name, "", self._pids)
        self._nodes[name] = Node(
            name, given.host or before.host, before.pid, lifecycle=given.lifecycle or before.lifecycle
        )

    def _graph(self) -> Graph:
        ends = []
        for topic, misfit in self._misfits.items():
            ends.append(Endpoint("/given", Role.PUBLISHER, topic, "given/A"))
            ends.append(Endpoint("/taking", Role.SUBSCRIPTION, topic, "given/B" if misfit else "given/A"))
        ends += [
            Endpoint("/given", Role.SERVICE_SERVER, one.name) for one in self._others if one.kind is EntityKind.SERVICE
        ]
        hosts = {one.name for one in self._others if one.kind is EntityKind.HOST}
        processes = [_process(one.name) for one in self._others if one.kind is EntityKind.PROCESS]
        return Graph(
            "ros2",
            tuple(sorted(self._nodes.values())),
            tuple(sorted(ends)),
            tuple(sorted(hosts)),
            tuple(sorted(processes)),
            {node: dict(values) for node, values in self._parameters.items()},
        )


def _process_end(given: Given, node: Node, ended: str) -> Event:
    process = EntityId(EntityKind.PROCESS, f"{node.host}/{node.pid}")
    return Event(given.at_s, Change.VANISHED, str(process), ended=ended)


def _process(name: str) -> Process:
    host, _, pid = name.rpartition("/")
    return Process(host, int(pid) if pid.isdecimal() else 0)


def _verdict(given: Given) -> Verdict:
    state = given.state or State.UNKNOWN
    return Verdict(
        entity=given.entity,
        expectation=f"given.{given.entity}.{given.signal}",
        quantity=given.signal,
        state=state,
        since=given.at_s,
        time=given.at_s,
        value=given.number,
        severity=given.severity,
        evidence="given",
        cause=given.cause if state.bad else "",
    )
