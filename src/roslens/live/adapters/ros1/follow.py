"""Following a master that may be gone, come back, or be another one than before."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec

from roslens.live.adapters.ros1.master import Master, Registrations, SystemState
from roslens.live.adapters.ros1.names import TOOL, is_observer
from roslens.live.adapters.ros1.wire.xml_rpc import CallError
from roslens.model.failure import Failure

TOPIC_OF_ALL = "/rosout"
"""On which every node publishes, so that its publishers are the nodes."""


class Step(msgspec.Struct, frozen=True):
    """What a look at the master brought.

    Attributes:
        changed: registrations differ from those before.
        news: what is to be said of the master itself, empty where nothing.
        failures: what the master did not tell.
        restarted: it is another master than before.
    """

    changed: bool = False
    news: str = ""
    failures: tuple[Failure, ...] = ()
    restarted: bool = False


class Follower:
    """Keeps registrations and types as the master last reported them, and ourselves registered for its updates.

    Args:
        master: to follow.
        caller: our own name.
        api: the URI of our own API; empty to register for nothing.
        publications: topics that we publish, with the types of their messages.

    Attributes:
        state: registrations, ours left out.
        types: of topics by name.
        there: whether the master answered last.
    """

    def __init__(self, master: Master, caller: str, api: str, publications: Sequence[tuple[str, str]] = ()) -> None:
        self.state = SystemState()
        self.types: dict[str, str] = {}
        self.there = False
        self.ever = False
        self._master = master
        self._caller = caller
        self._api = api
        self._publications = publications
        self._pid = 0
        self._type_failures: tuple[Failure, ...] = ()

    def step(self) -> Step:
        """Ask the master."""
        try:
            return self._ask()
        except CallError as error:
            news = f"the ROS master at {self._master.uri} is gone: {error}" if self.there else ""
            self.there = False
            what = f"no ROS master: {error}"
            if self.ever:
                what = f"the ROS master is gone: {error}; the known nodes are those from before"
            advice = "Start roscore, or name the master by ROS_MASTER_URI or --master"
            return Step(news=news, failures=(Failure(TOOL, what, "a master that answers", advice),))

    def _ask(self) -> Step:
        restarted = False
        state, changed = self._master.state()
        if changed or not self.there:
            pid = self._master.pid()
            restarted = bool(self._pid) and pid != self._pid
            if restarted:
                self._master.forget()
            if restarted or not self._pid:
                self._register()
                state, _ = self._master.state()
                changed = True
            self._pid = pid
            self.types, self._type_failures = self._master.types()
        news = ""
        if not self.there and self.ever:
            news = f"the ROS master at {self._master.uri} answers again"
        if restarted:
            news = f"the ROS master at {self._master.uri} was restarted; nodes started before are unknown to it"
        self.there = self.ever = True
        self.state = without(state, self._caller)
        return Step(changed, news, (*state.oddities, *self._type_failures), restarted)

    def _register(self) -> None:
        if self._api:
            self._master.subscribe(TOPIC_OF_ALL, "*", self._api)
            for topic, type_ in self._publications:
                self._master.publish(topic, type_, self._api)

    def home(self, node: str, fresh: bool = False) -> str:
        """Return the URI of the API of a node.

        Raises:
            CallError: the master does not tell.
        """
        return self._master.home(node, fresh)

    def leave(self, ignore: Callable[[str], None]) -> None:
        """Take our registration back; what goes wrong is passed to ``ignore``."""
        if self._pid and self._api:
            try:
                for topic, _ in self._publications:
                    self._master.unpublish(topic, self._api)
                self._master.unsubscribe(TOPIC_OF_ALL, self._api)
            except CallError as error:
                ignore(str(error))
        self._master.close()


def without(state: SystemState, caller: str) -> SystemState:
    """Return registrations without our own, and those of other observers."""

    def part(pairs: Registrations) -> Registrations:
        return tuple(pair for pair in pairs if pair[1] != caller and not is_observer(pair[1]))

    return SystemState(part(state.publishers), part(state.subscribers), part(state.services), state.oddities)
