"""The master: who is registered for what, and where each node's own API is."""

from __future__ import annotations

from typing import Any

import msgspec

from roslens.live.adapters.ros1.names import MOST_ENTRIES, Oddities, sound_name
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.xml_rpc import Caller, CallError, Trouble, read_answer, split_uri, unwrap
from roslens.model.failure import Failure

Registrations = tuple[tuple[str, str], ...]


class SystemState(msgspec.Struct, frozen=True):
    """Pairs of topic or service and node, sorted; ``oddities`` is what was left out of them."""

    publishers: Registrations = ()
    subscribers: Registrations = ()
    services: Registrations = ()
    oddities: tuple[Failure, ...] = ()

    @property
    def nodes(self) -> tuple[str, ...]:
        """The names of all nodes, sorted."""
        return tuple(sorted({node for part in (self.publishers, self.subscribers, self.services) for _, node in part}))


def read_registrations(value: Any, oddities: Oddities) -> Registrations:
    """Read ``[[name, [node, …]], …]``, leaving out and noting what is not of this form."""
    if not isinstance(value, list):
        oddities.add("registrations that are", value, "a list")
        return ()
    pairs: set[tuple[str, str]] = set()
    for entry in value:
        for name, node in _registered(entry, oddities):
            if len(pairs) >= MOST_ENTRIES:
                oddities.add("registrations after the first 100,000, beginning with", node, "fewer")
                return tuple(sorted(pairs))
            if sound_name(node):
                pairs.add((name, node))
            else:
                oddities.add("the name of a node", node, "a printable name of at most 1,024 characters")
    return tuple(sorted(pairs))


def _registered(entry: Any, oddities: Oddities) -> list[tuple[str, Any]]:
    """Return the pairs of an entry ``[name, [node, …]]``; none, and a note, where it is not of this form."""
    if not (isinstance(entry, list) and len(entry) == 2 and isinstance(entry[1], list)):
        oddities.add("the registration", entry, "[name, [node, ...]]")
        return []
    name, nodes = entry
    if not sound_name(name):
        oddities.add("the name", name, "a printable name of at most 1,024 characters")
        return []
    return [(name, node) for node in nodes]


def read_state(value: Any, source: str) -> SystemState:
    """Read what getSystemState returns.

    Raises:
        CallError: it has not the three parts.
    """
    if not isinstance(value, list) or len(value) != 3:
        raise CallError(Trouble.GARBLED, f"the system state is {repr(value)[:80]}, expected three lists")
    oddities = Oddities(source)
    parts = [read_registrations(part, oddities) for part in value]
    return SystemState(parts[0], parts[1], parts[2], oddities.failures())


def read_types(value: Any, source: str) -> tuple[dict[str, str], tuple[Failure, ...]]:
    """Read what getTopicTypes returns, and what had to be left out."""
    oddities = Oddities(source)
    types: dict[str, str] = {}
    if not isinstance(value, list):
        oddities.add("types of topics that are", value, "a list")
        value = []
    for entry in value[:MOST_ENTRIES]:
        if isinstance(entry, list) and len(entry) == 2 and sound_name(entry[0]) and sound_name(entry[1]):
            types[entry[0]] = "" if entry[1] == "*" else entry[1]
        else:
            oddities.add("the type", entry, "[topic, type]")
    return types, oddities.failures()


class Master:
    """The master at a URI, asked as node ``caller``; for one thread."""

    def __init__(self, uri: str, caller: str, resolver: Resolver, wait_s: float = 2.0) -> None:
        self.uri = uri
        self._caller = caller
        self._line = Caller(uri, resolver, wait_s)
        self._body = b""
        self._state = SystemState()
        self._homes: dict[str, str] = {}

    def state(self) -> tuple[SystemState, bool]:
        """Return the registrations, and whether they differ from those returned before.

        Raises:
            CallError: the master does not tell.
        """
        body = self._line.ask("getSystemState", self._caller)
        if body == self._body:
            return self._state, False
        state = read_state(unwrap(read_answer(body, "getSystemState"), "getSystemState"), self.uri)
        changed = not self._body or state != self._state
        self._body, self._state = body, state
        return state, changed

    def types(self) -> tuple[dict[str, str], tuple[Failure, ...]]:
        """Return the types of topics by name, and what had to be left out.

        Raises:
            CallError: the master does not tell.
        """
        return read_types(self._call("getTopicTypes"), self.uri)

    def pid(self) -> int:
        """Return the process id of the master; another one means that the master was restarted.

        Raises:
            CallError: the master does not tell.
        """
        pid = self._call("getPid")
        return pid if isinstance(pid, int) else 0

    def home(self, node: str, fresh: bool = False) -> str:
        """Return the URI of the API of a node; remembered unless it is to be asked ``fresh``.

        Raises:
            CallError: the master does not know the node, or does not tell.
        """
        if fresh or node not in self._homes:
            self._homes.pop(node, None)
            uri = self._call("lookupNode", node)
            if not isinstance(uri, str):
                raise CallError(Trouble.GARBLED, f"the URI of {node} is {repr(uri)[:80]}, expected a text")
            split_uri(uri)
            self._homes[node] = uri
        return self._homes[node]

    def forget(self) -> None:
        """Forget what was remembered, since the master is another one now."""
        self._body = b""
        self._homes.clear()

    def subscribe(self, topic: str, type_: str, api: str) -> tuple[str, ...]:
        """Register as a subscriber, to be notified of publishers; return their URIs.

        Raises:
            CallError: the master does not register it.
        """
        uris = self._call("registerSubscriber", topic, type_, api)
        return tuple(uri for uri in uris if isinstance(uri, str)) if isinstance(uris, list) else ()

    def unsubscribe(self, topic: str, api: str) -> None:
        """Take the registration back.

        Raises:
            CallError: the master does not answer.
        """
        self._call("unregisterSubscriber", topic, api)

    def publish(self, topic: str, type_: str, api: str) -> None:
        """Register as a publisher, of which subscribers are notified.

        Raises:
            CallError: the master does not register it.
        """
        self._call("registerPublisher", topic, type_, api)

    def unpublish(self, topic: str, api: str) -> None:
        """Take the registration back.

        Raises:
            CallError: the master does not answer.
        """
        self._call("unregisterPublisher", topic, api)

    def parameters(self) -> Any:
        """Return all parameters as tables within tables.

        Raises:
            CallError: the master does not tell.
        """
        return self.parameter("/")

    def parameter(self, name: str) -> Any:
        """Return the value of a parameter; a table where it is a namespace.

        Raises:
            CallError: there is none, or the master does not tell.
        """
        return self._call("getParam", name)

    def subscribe_parameters(self, api: str) -> Any:
        """Register to be notified of all parameters that are set or deleted; return them as they are now.

        Raises:
            CallError: the master does not register it.
        """
        return self._call("subscribeParam", api, "/")

    def unsubscribe_parameters(self, api: str) -> None:
        """Take that registration back.

        Raises:
            CallError: the master does not answer.
        """
        self._call("unsubscribeParam", api, "/")

    def close(self) -> None:
        """Hang up."""
        self._line.close()

    def _call(self, method: str, *arguments: str) -> Any:
        return unwrap(self._line.call(method, self._caller, *arguments), method)
