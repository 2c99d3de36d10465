"""The parameter server: read once, updated by notifications of the master, and read again now and then.

The master calls back for every change below ``/`` of who subscribed to it, so that nothing is asked again and again.
What did not arrive, because the way back is closed, is found when all is read a minute later.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from typing import Any, Protocol

from roslens.live.adapters.ros1.names import TOOL, sound_name
from roslens.live.adapters.ros1.wire.xml_rpc import CallError
from roslens.live.reported.parameter_changes import parameter_events
from roslens.live.reported.parameter_text import HIDDEN, is_secret, value_text
from roslens.model.failure import Failure
from roslens.model.graph import Event

RENEW_S = 60.0
MOST = 20_000
"""Parameters that are kept; what is more is left out, with a word about it."""
_DEEPEST = 32
MOST_UPDATES = 50
"""Of one round; where more comes, as when a launch file is loaded, all is read anew instead."""


class Server(Protocol):
    """The parameter server of a master."""

    def subscribe_parameters(self, api: str) -> Any: ...  # noqa: D102
    def unsubscribe_parameters(self, api: str) -> None: ...  # noqa: D102
    def parameters(self) -> Any: ...  # noqa: D102


class Parameters:
    """Parameters as text, by full name.

    Args:
        server: to ask.
        api: the URI at which the master calls back; empty where it cannot.
        steady: a clock that never jumps.
        submit: runs what may take long, elsewhere.

    Attributes:
        moved: whether something is other than when ``by_node`` was last called.
    """

    def __init__(
        self, server: Server, api: str, steady: Callable[[], float], submit: Callable[[Callable[[], Any]], Future[Any]]
    ) -> None:
        self._server = server
        self._api = api
        self._steady = steady
        self._values: dict[str, str] = {}
        self._known = False
        self._due = float("-inf")
        self._lock = threading.Lock()
        self._updates: list[tuple[str, Any]] = []
        self._by_node: tuple[tuple[str, ...], dict[str, dict[str, str]]] = ((), {})
        self.moved = True
        self._full = False
        self._submit = submit
        self._reading: Future[Any] | None = None
        self._subscribed = False

    def note(self, key: str, value: Any) -> None:
        """Take the notification of a parameter that was set or, with an empty table, deleted; in any thread."""
        with self._lock:
            self._updates.append((key, value))
            if len(self._updates) > MOST_UPDATES:
                self._due = float("-inf")
                del self._updates[1:]

    def step(self, time: float, *, restarted: bool = False) -> tuple[list[Event], list[Failure]]:
        """Take up what changed until ``time``, seconds since the epoch; ``restarted`` is a master that knows us not.

        Nothing here waits: what is read is taken up by a later step.
        """
        if restarted:
            self._subscribed, self._due = False, float("-inf")
        with self._lock:
            updates, self._updates = self._updates, []
        if self._reading is None and self._steady() >= self._due:
            self._due = self._steady() + RENEW_S
            self._reading = self._submit(self._read)
        values, failures = self._values, list[Failure]()
        if self._reading is not None and self._reading.done():
            values, failures = self._taken(self._reading)
            self._reading = None
        if updates:
            values = dict(values)
            for key, value in updates:
                put(values, key, value)
        if values == self._values:
            return [], failures
        before, self._values = self._values, values
        self.moved = True
        known, self._known = self._known, True
        return (parameter_events(before, values, time) if known else []), failures

    def _read(self) -> Any:
        if self._subscribed or not self._api:
            return self._server.parameters()
        tree = self._server.subscribe_parameters(self._api)
        self._subscribed = True
        return tree

    def _taken(self, reading: Future[Any]) -> tuple[dict[str, str], list[Failure]]:
        try:
            tree = reading.result()
        except CallError as error:
            what = f"parameters are not reported: {error}"
            return self._values, [Failure(TOOL, what, "an answer of the parameter server", partial=True)]
        values: dict[str, str] = {}
        put(values, "/", tree)
        return values, self._too_many(values)

    def _too_many(self, values: dict[str, str]) -> list[Failure]:
        if len(values) < MOST or self._full:
            return []
        self._full = True
        return [
            Failure(
                TOOL, f"more than {MOST:,} parameters", f"at most {MOST:,}", "The rest is left out", partial=True
            )
        ]  # fmt: skip

    def by_node(self, nodes: Iterable[str]) -> dict[str, dict[str, str]]:
        """Return parameters by node: by the name within its namespace; those of no node under an empty name."""
        names = tuple(sorted(nodes))
        if self.moved or names != self._by_node[0]:
            self._by_node = (names, grouped(self._values, frozenset(names)))
            self.moved = False
        return self._by_node[1]

    def leave(self, ignore: Callable[[str], None]) -> None:
        """Ask for no more news; what goes wrong is passed to ``ignore``."""
        if self._subscribed and self._reading is None:
            try:
                self._server.unsubscribe_parameters(self._api)
            except CallError as error:
                ignore(str(error))


def put(values: dict[str, str], key: str, value: Any) -> None:
    """Replace what is at ``key`` and below by ``value``, whose tables become names; an empty one is a deletion."""
    root = "/" + "/".join(part for part in key.split("/") if part)
    below = root if root == "/" else f"{root}/"
    for name in [name for name in values if name == root or name.startswith(below)]:
        del values[name]
    place = len(root)
    while (place := root.rfind("/", 0, place)) > 0:
        values.pop(root[:place], None)
    _fill(values, "" if root == "/" else root, value, 0)


def _fill(values: dict[str, str], name: str, value: Any, depth: int) -> None:
    if isinstance(value, dict) and depth < _DEEPEST:
        for key, inner in value.items():
            if sound_name(key):
                _fill(values, f"{name}/{key}", inner, depth + 1)
    elif sound_name(name) and len(values) < MOST:
        values[name] = HIDDEN if any(is_secret(part) for part in name.split("/")) else value_text(name, value)


def grouped(values: dict[str, str], nodes: frozenset[str]) -> dict[str, dict[str, str]]:
    """Return parameters by the node in whose namespace they are, the innermost one; without one under ``""``."""
    found: dict[str, dict[str, str]] = {}
    for name, value in sorted(values.items()):
        place = len(name)
        while (place := name.rfind("/", 0, place)) > 0:
            if name[:place] in nodes:
                found.setdefault(name[:place], {})[name[place + 1 :]] = value
                break
        else:
            found.setdefault("", {})[name] = value
    return found
