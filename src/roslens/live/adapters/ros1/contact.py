"""One node and what it last reported of itself."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from roslens.live.adapters.ros1.bus import Reading
from roslens.live.adapters.ros1.names import TOOL, odd
from roslens.live.adapters.ros1.place import is_local, owns_port
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.slave import Link, Slave
from roslens.live.adapters.ros1.wire.xml_rpc import CallError, Trouble, split_uri
from roslens.model.failure import Failure
from roslens.model.graph import Node

RENEW_LINKS = 10
"""Rounds after which connections are asked for again though no new counter appeared."""
LONGEST_PAUSE = 16
"""Rounds for which a node that does not answer is left alone at most."""
_DEAD = "registered, but its API refuses connections"


class Look(msgspec.Struct, frozen=True):
    """What came of asking a node: its counters, or why there are none."""

    reading: Reading | None = None
    trouble: Trouble | None = None
    failures: tuple[Failure, ...] = ()


class Contact:
    """Asks one node for its process, its counters and, where new ones appear, its connections.

    Attributes:
        name: of the node.
        uri: of its API.
        dead: nobody listens at its API.
        refusals: how often in a row it was asked since nobody has listened.
        node: what is known of it.
        local: whether it runs on this host.
        met: whether it was asked to the end, whatever came of it.
    """

    def __init__(
        self, name: str, uri: str, caller: str, resolver: Resolver, hostname: str, wait_s: float = 1.0
    ) -> None:
        self.name = name
        self.uri = uri
        self.dead = False
        self.refusals = 0
        self.local = False
        self.met = False
        self.node = Node(name)
        self._slave = Slave(uri, caller, resolver, wait_s)
        self._resolver = resolver
        self._hostname = hostname
        self._links: tuple[Link, ...] = ()
        self._rounds = 0
        self._pause = 0
        self._silences = 0
        self._before = Look()

    def look(self, clock: Callable[[], float], force: bool = False) -> Look:
        """Ask; a node that was silent is asked again only after pauses that grow, unless ``force``."""
        if self._pause > 0 and not force:
            self._pause -= 1
            return self.unanswered
        self._before = self._ask(clock)
        silent = self._before.trouble in (Trouble.SILENT, Trouble.UNREACHABLE)
        self._silences = self._silences + 1 if silent else 0
        self._pause = min(2**self._silences // 2, LONGEST_PAUSE) if silent else 0
        self.dead = self._before.trouble is Trouble.REFUSED
        self.refusals = self.refusals + 1 if self.dead else 0
        self.met = True
        return self._before

    @property
    def unanswered(self) -> Look:
        """What is known of it while it has not answered."""
        return msgspec.structs.replace(self._before, reading=None)

    def _ask(self, clock: Callable[[], float]) -> Look:
        try:
            failures = self._locate()
            stats = self._slave.stats()
            self._rounds += 1
            known = {(link.id, link.topic, link.sends) for link in self._links}
            fresh = any((c.id, c.topic, c.sends) not in known for c in stats.counters)
            reported: tuple[Failure, ...] = ()
            if fresh or self._rounds % RENEW_LINKS == 1:
                self._links, reported = self._slave.links()
        except CallError as error:
            return Look(None, error.trouble, (self._failure(error),))
        reading = Reading(self.name, self.uri, clock(), stats, self._links)
        return Look(reading, None, (*failures, *stats.oddities, *reported))

    def _locate(self) -> tuple[Failure, ...]:
        """Find out host and process, once."""
        if self.node.host:
            return ()
        host, port = split_uri(self.uri)
        pid = self._slave.pid()
        self.local = is_local(self._resolver.address(host))
        if not self.local:
            self.node = Node(self.name, host, pid, ("api",))
        elif owns_port(pid, port) is False:
            self.node = Node(self.name, self._hostname)
            what = f"reports that it is process {pid}, which does not listen at port {port} on this host"
            return (odd(what, f"node:{self.name}", "its process as it is numbered here, not in a container"),)
        else:
            self.node = Node(self.name, self._hostname, pid, ("api",))
        return ()

    def _failure(self, error: CallError) -> Failure:
        entity = f"node:{self.name}"
        if error.trouble is Trouble.REFUSED:
            advice = "It ended without unregistering; `rosnode cleanup` removes such registrations"
            return Failure(TOOL, f"{_DEAD}: {self.uri[:120]}", "a node that answers, or none", advice, entity=entity)
        advice = {
            Trouble.SILENT: "See whether it hangs or is stopped; it is asked again less often until it answers",
            Trouble.UNREACHABLE: "Set ROS_IP or ROS_HOSTNAME where the node runs to what this host can reach",
            Trouble.GARBLED: "See which program listens there",
            Trouble.DENIED: "Data from its peers and taps is still reported; rospy cannot report counters over 2 GB",
        }[error.trouble]
        return Failure(TOOL, str(error), "an answer to the calls of a node's API", advice, entity=entity, partial=True)

    @property
    def reason(self) -> str:
        """Why it is not among the nodes that live; empty where it is."""
        return _DEAD if self.dead else ""

    @property
    def descriptor(self) -> int:
        """The open connection to its API, -1 without one."""
        return self._slave.descriptor

    def close(self) -> None:
        """Hang up."""
        self._slave.close()
