"""Rounds of observation: master, nodes and their counters become frames."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait

import msgspec

from roslens.live.adapters.ros1.beyond_master.apart import Apart
from roslens.live.adapters.ros1.beyond_master.orphans import Orphans
from roslens.live.adapters.ros1.beyond_master.publisher_types import PublisherTypes, asked_type
from roslens.live.adapters.ros1.bus import Bus, Reading
from roslens.live.adapters.ros1.contact import Contact, Look
from roslens.live.adapters.ros1.ends import Ends
from roslens.live.adapters.ros1.follow import TOPIC_OF_ALL, Follower
from roslens.live.adapters.ros1.graph import build_graph, changes
from roslens.live.adapters.ros1.parameters import Parameters
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.xml_rpc import CallError, Trouble
from roslens.live.system.misfit import misfits
from roslens.model.failure import Failure
from roslens.model.graph import Change, Event, Graph
from roslens.model.traffic.tally import Tally
from roslens.model.wire import VERSION, Frame

_AT_ONCE = 8
"""So many nodes are asked at a time."""
_PATIENCE_S = 0.2
"""A round waits no longer for the next answer of a node that answered before; what comes later counts in the next one,
so that a node that hangs does not make all others seem silent."""
PARAMETERS_S = 5.0
"""A graph of which only parameters changed is reported so often at most; each change is an event at once."""
_SEEK_AT_ONCE = 20
"""Rounds in which a dead node is looked up in each one: it may have been started again, with another API."""
_SEEK_DEAD = 5
"""Rounds after which a node that is dead for longer is looked up anew."""


class Observation:
    """Observes one ROS 1 system.

    Args:
        follower: of its master.
        caller: our own name, which is left out of everything.
        resolver: of hosts.
        hostname: of this host.
        clock: seconds since the epoch.
        ends: tells of nodes that end; None where nobody wants to know at once.
        wait_s: the longest a node may take to answer.
        parameters: of the master's parameter server; None to leave them out.
    """

    def __init__(
        self,
        follower: Follower,
        caller: str,
        resolver: Resolver,
        hostname: str,
        clock: Callable[[], float],
        ends: Ends | None = None,
        wait_s: float = 1.0,
        parameters: Parameters | None = None,
    ) -> None:
        self._parameters = parameters
        self._parameters_reported = float("-inf")
        self._follower = follower
        self._caller = caller
        self._resolver = resolver
        self._hostname = hostname
        self._clock = clock
        self._ends = ends
        self._wait_s = wait_s
        self._bus = Bus(frozenset({caller}), hostname)
        self._contacts: dict[str, Contact] = {}
        self._left: list[tuple[str, Contact]] = []
        self._graph: Graph | None = None
        self._said: set[Failure] = set()
        self._unframed: set[str] = set()
        self._rounds = 0
        self._orphans = Orphans()
        self._pool = ThreadPoolExecutor(_AT_ONCE, "node")
        self._asked: dict[Contact, Future[Look]] = {}
        self._apart = Apart()
        self._types = PublisherTypes(
            lambda uri, topic: asked_type(uri, topic, caller, resolver, wait_s),
            self._pool,
        )

    @property
    def publishers(self) -> dict[str, list[tuple[str, str]]]:
        """Name and URI of the living publishers of each topic."""
        found: dict[str, list[tuple[str, str]]] = {}
        for topic, node in self._follower.state.publishers:
            contact = self._contacts.get(node)
            if contact and not contact.dead:
                found.setdefault(topic, []).append((node, contact.uri))
        return found

    @property
    def unframed(self) -> frozenset[str]:
        """Nodes that count messages they receive without the length before them, which is what roscpp does."""
        return frozenset(self._unframed)

    def round(self, moved: frozenset[str] = frozenset()) -> Frame:
        """Ask everybody; ``moved`` are nodes whose API may be elsewhere now."""
        self._rounds += 1
        before, types = self._follower.state, self._follower.types
        step = self._follower.step()
        alive = {name for name, contact in self._contacts.items() if not contact.dead}
        if step.restarted:
            self._orphans.adopt(before, types, alive)
        self._orphans.follow(self._follower.state, alive)
        failures = [*step.failures, *self._orphans.failures()]
        if self._follower.there:
            failures += self._meet(moved)
        looks = self._look(list(self._contacts.values()), force=False)
        readings = [look.reading for look in looks if look.reading]
        for look in looks:
            failures += look.failures
        tallies = self._tallies(readings)
        set_since: list[Event] = []
        if self._parameters and self._follower.there:
            set_since, unread = self._parameters.step(self._clock(), restarted=step.restarted)
            failures += unread
        self._compare(readings)
        now = self._clock()
        events, graph = self._renew(now)
        failures += self._misfits()
        fresh = [failure for failure in dict.fromkeys(failures) if failure not in self._said]
        self._said = set(failures)
        if step.news:
            events.insert(0, Event(now, Change.CHANGED, f"host:{self._hostname}", step.news))
        return self._frame(now, tallies, [*events, *set_since], graph, fresh)

    def between(self) -> Frame:
        """Return an empty frame, for what is received between two rounds."""
        return self._frame(self._clock(), [], [], None, [])

    def ended(self, names: Iterable[str]) -> Frame | None:
        """Ask only nodes that seem to have ended; None where that was not so."""
        contacts = [self._contacts[name] for name in sorted(set(names)) if name in self._contacts]
        looks = self._look(contacts, force=True)
        now = self._clock()
        events, graph = self._renew(now)
        if graph is None:
            return None
        fresh = [failure for look in looks for failure in look.failures if failure not in self._said]
        self._said.update(fresh)
        return self._frame(now, self._tallies([look.reading for look in looks if look.reading]), events, graph, fresh)

    def moved(self, topic: str, uris: tuple[str, ...]) -> frozenset[str]:
        """Return the nodes whose API may be elsewhere by what the master reported of the publishers of a topic."""
        if topic != TOPIC_OF_ALL:
            return frozenset()
        reported = {uri.rstrip("/") for uri in uris}
        return frozenset(
            name for name, contact in self._contacts.items() if contact.dead or contact.uri.rstrip("/") not in reported
        )

    def _meet(self, moved: frozenset[str]) -> list[Failure]:
        """Make the contacts those of the nodes that are registered, or were at a master before and run on."""
        failures = []
        names = self._follower.state.nodes
        for name in sorted(self._contacts.keys() - set(names) - self._orphans.names):
            self._part(name)
        for name in names:
            contact = self._contacts.get(name)
            if contact is None or name in moved or self._may_be_back(contact):
                failures += self._contact(name)
        return failures

    def _contact(self, name: str) -> list[Failure]:
        """Ask where a node is, and get into contact with it unless it is there already."""
        contact = self._contacts.get(name)
        try:
            uri = self._follower.home(name, fresh=contact is not None)
        except CallError as error:
            if error.trouble is Trouble.DENIED:  # it unregistered just now
                return []
            return [Failure("ros1", str(error), "the URI of its API", entity=f"node:{name}")]
        if contact is None or contact.uri != uri:
            self._part(name)
            self._contacts[name] = Contact(name, uri, self._caller, self._resolver, self._hostname, self._wait_s)
        return []

    def _may_be_back(self, contact: Contact) -> bool:
        return contact.dead and (contact.refusals <= _SEEK_AT_ONCE or self._rounds % _SEEK_DEAD == 0)

    def _part(self, name: str) -> None:
        contact = self._contacts.pop(name, None)
        if contact:
            contact.close()
            self._asked.pop(contact, None)
            self._bus.forget(name)
            self._unframed.discard(name)
            if self._ends:
                self._ends.forget(name)

    def _look(self, contacts: list[Contact], force: bool) -> list[Look]:
        for contact in contacts:
            if contact not in self._asked:
                self._asked[contact] = self._pool.submit(contact.look, self._clock, force)
        self._wait([contact for contact in contacts if force or not contact.met], None)
        self._wait(contacts, _PATIENCE_S)
        looks = [self._answer(contact) for contact in contacts]
        for contact, look in zip(contacts, looks, strict=True):
            if look.trouble is Trouble.REFUSED and self._ends:
                self._ends.forget(contact.name)
            elif look.reading and self._ends:
                if contact.local and contact.node.pid:
                    self._ends.process(contact.name, contact.node.pid)
                self._ends.connection(contact.name, contact.descriptor)
        return looks

    def _wait(self, contacts: list[Contact], patience_s: float | None) -> None:
        """Wait for answers, but no longer than ``patience_s`` for the next one."""
        left = {self._asked[contact] for contact in contacts}
        while left:
            answered, left = wait(left, patience_s, FIRST_COMPLETED)
            if not answered:
                return

    def _answer(self, contact: Contact) -> Look:
        asked = self._asked[contact]
        if not asked.done():
            return contact.unanswered
        del self._asked[contact]
        return asked.result()

    def _compare(self, readings: list[Reading]) -> None:
        """Find out who is not connected, and what their publishers send."""
        state = self._orphans.with_state(self._follower.state)
        self._apart.take(state, readings)
        wanted = ((topic, node, self._contacts.get(node)) for topic, node in self._apart.wanted(state))
        self._types.want((topic, node, one.uri) for topic, node, one in wanted if one is not None and not one.dead)

    def _misfits(self) -> list[Failure]:
        found = misfits(self._graph.endpoints) if self._graph is not None else ()
        return [msgspec.structs.replace(failure, tool="ros1") for failure in found]

    def _tallies(self, readings: list[Reading]) -> list[Tally]:
        self._unframed.update(reading.node for reading in readings if reading.stats.wraps)
        homes = {contact.uri.rstrip("/"): name for name, contact in self._contacts.items()}
        return self._bus.tallies(readings, homes)

    def _renew(self, now: float) -> tuple[list[Event], Graph | None]:
        """Return what changed, and the graph if anything did; the first graph has no events."""
        living = {name: contact.node for name, contact in self._contacts.items() if not contact.dead}
        state, types = self._orphans.with_state(self._follower.state), self._orphans.with_types(self._follower.types)
        graph = self._apart.completed(build_graph(state, types, living), self._types.of)
        before = self._graph
        if self._parameters:
            # New knowledge of parameters is no reason to report the whole at once.
            graph = msgspec.structs.replace(graph, parameters=before.parameters if before else {})
        if before == graph and not self._parameters_due(now):
            return [], None
        if self._parameters:
            graph = msgspec.structs.replace(graph, parameters=self._parameters.by_node(living))
        self._graph = graph
        dead = {name: contact.reason for name, contact in self._contacts.items() if contact.dead}
        return (changes(before, graph, now, dead, dead) if before else []), graph

    def _parameters_due(self, now: float) -> bool:
        if not self._parameters or not self._parameters.moved or now - self._parameters_reported < PARAMETERS_S:
            return False
        self._parameters_reported = now
        return True

    def _frame(
        self, now: float, tallies: list[Tally], events: list[Event], graph: Graph | None, failures: list[Failure]
    ) -> Frame:
        return Frame(VERSION, f"{self._hostname}/ros1", 0, now, tallies, [], events, graph, failures)

    def close(self) -> None:
        """Hang up everywhere."""
        for name in list(self._contacts):
            self._part(name)
        self._pool.shutdown(wait=False, cancel_futures=True)
