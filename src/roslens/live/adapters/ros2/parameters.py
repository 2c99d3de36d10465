"""Parameters of nodes: asked for when a node appears, followed on ``/parameter_events`` from then on.

Nothing here waits. A few nodes are asked at a time, and new ones at a pace: every question is an endpoint that all of
the system hears of, and the two of a node cost about 15 ms of a core. At 10 nodes a second, 200 nodes take 20 s. A node
that does not answer, because nobody spins it, has parameters that are unknown; it is asked again twice, a minute apart.

A node without a publisher of ``/parameter_events`` (``start_parameter_event_publisher(false)``) tells no change. It is
asked again and again, one such node a second at most.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterable
from typing import Any, Protocol

import msgspec

from roslens.live.adapters.ros2 import TOOL
from roslens.live.adapters.ros2.gid import prefix
from roslens.live.reported.parameter_changes import parameter_events
from roslens.live.reported.parameter_text import HIDDEN, is_secret, value_text
from roslens.model.failure import Failure
from roslens.model.graph import Event, Graph, Role

EVENTS = "/parameter_events"
AT_ONCE = 4
PACE_S = 0.1
PATIENCE_S = 5.0
AGAIN_S = 60.0
TRIES = 3
REREAD_S = 10.0
"""Seconds from an answer until a node that tells no changes is asked anew."""
REREAD_PACE_S = 1.0
MOST = 2000
"""Parameters of a node; what is more is left out."""
_SERVICES = {
    "/list_parameters": "rcl_interfaces/srv/ListParameters",
    "/get_parameters": "rcl_interfaces/srv/GetParameters",
}
_PER_CALL = 200


class Asking(Protocol):
    """Questions to one node, which are asked step by step."""

    def step(self) -> dict[str, str] | None:
        """Go on as far as that goes without waiting; return the parameters when all of them are there."""

    def close(self) -> None:
        """Ask no more."""


class _Known(msgspec.Struct):
    """A node: its processes, by which one that was started again differs, what it reported, and whether it is silent.

    A silent one does not publish changes of its parameters.
    """

    life: frozenset[str]
    values: dict[str, str] | None = None
    tries: int = 0
    due: float = 0.0
    asking: Asking | None = None
    since: float = 0.0
    stale: bool = False
    silent: bool = False
    told: bool = False


class Parameters:
    """What is known of the parameters of all nodes.

    Args:
        connect: begins to ask a node.

    Attributes:
        news: whether something is known that was not when ``known`` was last called.
    """

    def __init__(self, connect: Callable[[str], Asking]) -> None:
        self.news = False
        self._connect = connect
        self._nodes: dict[str, _Known] = {}
        self._waiting: dict[str, None] = {}
        self._asked: set[str] = set()
        self._next = self._next_reread = 0.0
        self._events: list[Event] = []
        self._found: list[tuple[str, dict[str, str], dict[str, str]]] = []
        self._failures: list[Failure] = []

    @property
    def busy(self) -> bool:
        """Whether nodes are being asked, or are to be as soon as the pace allows."""
        return bool(self._asked or self._waiting)

    def follow(self, graph: Graph) -> None:
        """Ask nodes that are new, and forget those that are gone."""
        there = lives(graph)
        telling = {end.node for end in graph.endpoints if end.name == EVENTS and end.role is Role.PUBLISHER}
        for name in self._nodes.keys() - there.keys():
            self._forget(name)
        for name, life in there.items():
            known = self._nodes.get(name)
            if known is not None and known.life and life and known.life.isdisjoint(life):
                self._forget(name)
                known = None
            if known is None:
                known = self._nodes[name] = _Known(life)
                self._waiting[name] = None
            elif life:
                known.life = life
            known.silent = name not in telling

    def _forget(self, name: str) -> None:
        known = self._nodes.pop(name)
        self._waiting.pop(name, None)
        self._asked.discard(name)
        if known.asking is not None:
            known.asking.close()
        self.news |= known.values is not None

    def turn(self, now: float) -> None:
        """Take up answers and ask on; ``now`` is seconds on a clock that never jumps."""
        for name in sorted(self._asked):
            self._go_on(name, self._nodes[name], now)
        while self._waiting and len(self._asked) < AT_ONCE and now >= self._next:
            name = next(iter(self._waiting))
            del self._waiting[name]
            known = self._nodes[name]
            known.asking, known.since, known.stale = self._connect(name), now, False
            known.tries += 1
            self._asked.add(name)
            self._next = now + PACE_S

    def again(self, now: float) -> None:
        """Put those who did not answer a while ago in line once more, and of those who tell no changes the next."""
        due = [(known.due, name) for name, known in self._nodes.items() if known.due and now >= known.due]
        for _, name in due:
            known = self._nodes[name]
            if known.values is None:
                known.due = 0.0
                self._waiting[name] = None
        silent = [(time, name) for time, name in due if self._nodes[name].values is not None]
        if silent and now >= self._next_reread:
            self._next_reread = now + REREAD_PACE_S
            self._reread(min(silent)[1])
        for name, known in self._nodes.items():
            idle = known.asking is None and name not in self._waiting
            if known.silent and known.values is not None and not known.due and idle:
                known.due = now + REREAD_S

    def _reread(self, name: str) -> None:
        known = self._nodes[name]
        known.due = 0.0
        if not known.silent:
            return
        self._waiting[name] = None
        if not known.told:
            known.told = True
            self._failures.append(
                Failure(
                    TOOL, f"{name} does not publish {EVENTS}: changes of its parameters are noticed some seconds late",
                    "a publisher that tells of each change at once",
                    "Leave start_parameter_event_publisher as it is by default", entity=f"node:{name}", partial=True,
                )
            )  # fmt: skip

    def _go_on(self, name: str, known: _Known, now: float) -> None:
        if known.asking is None:
            return
        found = known.asking.step()
        if found is None and now - known.since < PATIENCE_S:
            return
        known.asking.close()
        known.asking = None
        self._asked.discard(name)
        if found is None:
            self._let_go(known, now)
        elif known.stale and known.tries < TRIES:
            self._waiting[name] = None
        else:
            self._answered(name, known, found)

    def _let_go(self, known: _Known, now: float) -> None:
        known.due = now + AGAIN_S if known.tries < TRIES or known.told else 0.0
        if known.tries >= TRIES and known.values is not None:
            # What it said long ago and tells no changes of is not known any more.
            known.values, self.news = None, True

    def _answered(self, name: str, known: _Known, found: dict[str, str]) -> None:
        if known.values is not None and known.values != found:
            self._found.append((name, known.values, found))
        self.news |= known.values != found
        known.values, known.tries = found, 0

    def note(self, name: str, now: dict[str, str], deleted: Iterable[str], time: float) -> None:
        """Take what a node reported of itself at ``time``: values that are other ``now``, and names that are gone."""
        known = self._nodes.get(name)
        if known is None:
            return
        # The answers on the way may be older or newer than this.
        known.stale = known.asking is not None
        if known.values is None:
            return
        values = {**known.values, **now}
        for gone in deleted:
            values.pop(gone, None)
        if values == known.values or len(values) > MOST:
            return
        self._events += parameter_events(_full(name, known.values), _full(name, values), time)
        known.values = values
        self.news = True

    def events(self, time: float) -> list[Event]:
        """Return what happened since this was last asked; what was found by asking anew was found at ``time``."""
        events, self._events = self._events, []
        for name, before, after in self._found:
            events += parameter_events(_full(name, before), _full(name, after), time)
        self._found.clear()
        return events

    def failures(self) -> list[Failure]:
        """Return what could not be done since this was last asked."""
        failures, self._failures = self._failures, []
        return failures

    def known(self) -> dict[str, dict[str, str]]:
        """Return values as text by node; a node that reported nothing is not among them."""
        self.news = False
        return {name: known.values for name, known in sorted(self._nodes.items()) if known.values is not None}

    def close(self) -> None:
        """Ask no more."""
        for name in list(self._nodes):
            self._forget(name)


def lives(graph: Graph) -> dict[str, frozenset[str]]:
    """Return the nodes that offer their parameters, each with its processes as far as they are known."""
    offers: dict[str, int] = {}
    processes: dict[str, set[str]] = {}
    for end in graph.endpoints:
        if end.gid:
            processes.setdefault(end.node, set()).add(prefix(end.gid))
        elif end.role is Role.SERVICE_SERVER and end.name.startswith(end.node):
            offers[end.node] = offers.get(end.node, 0) + (_SERVICES.get(end.name[len(end.node) :]) == end.type)
    return {
        name: frozenset(processes.get(name, ())) for name, number in sorted(offers.items()) if number == len(_SERVICES)
    }


def _full(node: str, values: dict[str, str]) -> dict[str, str]:
    return {f"{node}/{name}": value for name, value in values.items()}


_FIELDS = (
    "", "bool_value", "integer_value", "double_value", "string_value", "byte_array_value", "bool_array_value",
    "integer_array_value", "double_array_value", "string_array_value",
)  # fmt: skip


def value_of(value: Any) -> Any:
    """Return what an rcl_interfaces/ParameterValue holds; None of one that is not set."""
    if not 0 < value.type < len(_FIELDS):
        return None
    found = getattr(value, _FIELDS[value.type])
    if value.type < 5:
        return found
    return b"".join(found) if value.type == 5 and found and isinstance(found[0], bytes) else list(found)


class NodeQuestions:
    """Queries one node by two clients of rclpy that do not need to be spun.

    Args:
        node: of rclpy.
        name: of the node that is asked.
        wanted: chooses the parameters whose values are asked for; by default all but secrets.
        shown: makes of name and value what ``step`` returns.
    """

    def __init__(
        self,
        node: Any,
        name: str,
        wanted: Callable[[str], bool] = lambda name: not is_secret(name),
        shown: Callable[[str, Any], Any] = value_text,
    ) -> None:
        self._wanted = wanted
        self._shown = shown
        services = importlib.import_module("rcl_interfaces.srv")
        self._node = node
        self._list = node.create_client(services.ListParameters, f"{name}/list_parameters")
        self._get = node.create_client(services.GetParameters, f"{name}/get_parameters")
        self._types = {self._list: services.ListParameters, self._get: services.GetParameters}
        self._asked: list[str] | None = None
        self._left: list[str] | None = None
        self._values: dict[str, Any] = {}
        self._listed = False

    def step(self) -> dict[str, Any] | None:
        """Go on as far as that goes without waiting; return the parameters when all of them are there."""
        if self._left is None and not self._names():
            return None
        if self._asked is not None:
            answer = self._answer(self._get)
            if answer is None:
                return None
            # A node that hides what was not declared answers with none at all.
            self._values.update(
                (name, self._shown(name, value_of(value)))
                for name, value in zip(self._asked, answer.values, strict=False)
            )
            self._asked = None
        if not self._left:
            return self._values
        if self._get.service_is_ready():
            self._asked, self._left = self._left[:_PER_CALL], self._left[_PER_CALL:]
            self._ask(self._get, names=self._asked)
        return None

    def _names(self) -> bool:
        if not self._listed:
            self._listed = self._list.service_is_ready()
            if self._listed:
                self._ask(self._list, depth=0)
            return False
        answer = self._answer(self._list)
        if answer is None:
            return False
        names = sorted(answer.result.names)[:MOST]
        self._values = {name: HIDDEN for name in names if is_secret(name)}
        self._left = [name for name in names if self._wanted(name)]
        return True

    def _ask(self, client: Any, **fields: object) -> None:
        with client.handle:
            client.handle.send_request(self._types[client].Request(**fields))

    def _answer(self, client: Any) -> Any:
        with client.handle:
            _, response = client.handle.take_response(self._types[client].Response)
        return response

    def close(self) -> None:
        """Let go of the clients."""
        for client in self._types:
            self._node.destroy_client(client)
