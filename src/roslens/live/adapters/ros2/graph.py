"""The graph of a ROS 2 system: what nodes have is asked at each change, what an endpoint is only where it changed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from typing import Any

from roslens.live.adapters.ros2.gid import host_bits, pid_bits, prefix, text_of
from roslens.live.adapters.ros2.lifecycle import Lifecycles
from roslens.live.adapters.ros2.local_process import Found, find_process
from roslens.model.graph import Endpoint, Graph, Node, Process, Role
from roslens.model.qos import Qos

OWN = "/_roslens_"
"""Nodes whose names begin so are observers and not part of what is observed."""
_UNKNOWN = "_NODE_NAME"
_FOREVER_S = 1e9
_TRIES = 3
_HIDDEN = "/_action/"
_ACTION = f"{_HIDDEN}send_goal"
_ROLES = {Role.SERVICE_SERVER: Role.ACTION_SERVER, Role.SERVICE_CLIENT: Role.ACTION_CLIENT}
_GOAL = "_SendGoal"

Listed = dict[str, tuple[int, frozenset[tuple[Role, str, str]]]]
"""Of each node how often its name is there, and role, name and type of what it has."""


class GraphReader:
    """Reads the graph through a node of its own.

    Args:
        node: of rclpy.
        host: the name of this host.
        find: finds a process by the bits that identifiers hold, and names of its nodes.
        lifecycles: asks managed nodes for their states; None leaves them out.

    Attributes:
        unsettled: whether something was not known yet and must be asked again soon.
    """

    def __init__(
        self,
        node: Any,
        host: str,
        find: Callable[[int, frozenset[str]], Found | None] = find_process,
        lifecycles: Lifecycles | None = None,
    ) -> None:
        self._node = node
        self._host = host
        self._find = find
        self._lifecycles = lifecycles
        self._listed: Listed = {}
        self._ends: dict[str, tuple[Endpoint, ...]] = {}
        self._found: dict[str, Found] = {}
        self._tries: Counter[str] = Counter()
        self._dead: set[str] = set()
        self._names: dict[str, str] = {}
        self._own: set[str] = set()
        self._again: set[str] = set()
        self._round: Iterator[str] = iter(())
        self._own_host = ""

    @property
    def unsettled(self) -> bool:
        """Whether something was not known yet and must be asked again soon."""
        return bool(self._again)

    def node_of(self, gid: str) -> str | None:
        """Return the node of an endpoint; None of one that never was there or is there no more."""
        return self._names.get(gid)

    def own(self, gid: str) -> bool:
        """Whether an endpoint is one of an observer, which is no part of what is observed."""
        return gid in self._own

    def pids(self) -> set[int]:
        """Return the processes of this host that are known to hold nodes."""
        return {found.pid for key, found in self._found.items() if key not in self._dead}

    def ended(self, pid: int) -> bool:
        """Take what a process held out of the graph; return whether there was something."""
        gone = {key for key, found in self._found.items() if found.pid == pid} - self._dead
        self._dead |= gone
        return bool(gone)

    def update(self) -> Graph:
        """Ask what changed and return the whole."""
        listed = self._list()
        changed = self._again | set(_changed(self._listed, listed))
        self._again = set()
        self._listed = listed
        for topic in sorted(changed):
            self._ask(topic)
        self._ends = {topic: ends for topic, ends in self._ends.items() if ends}
        return self._whole()

    def sweep(self, most: int) -> bool:
        """Ask anew for the next few topics; return whether one had changed unnoticed."""
        topics = list(islice(self._round, most))
        if len(topics) < most:
            self._round = iter(sorted(self._ends))
        before = [self._ends.get(topic) for topic in topics]
        for topic in topics:
            self._ask(topic)
        moved = self._lifecycles is not None and self._lifecycles.turn()
        return moved or [self._ends.get(topic) for topic in topics] != before

    def _list(self) -> Listed:
        node = self._node
        names = Counter(node.get_node_names_and_namespaces())
        listed: Listed = {}
        for (name, namespace), times in names.items():
            full = _full(name, namespace)
            if name.startswith(_UNKNOWN) or full.startswith(OWN):
                continue
            has: set[tuple[Role, str, str]] = set()
            for role, ask in (
                (Role.PUBLISHER, node.get_publisher_names_and_types_by_node),
                (Role.SUBSCRIPTION, node.get_subscriber_names_and_types_by_node),
                (Role.SERVICE_SERVER, node.get_service_names_and_types_by_node),
                (Role.SERVICE_CLIENT, node.get_client_names_and_types_by_node),
            ):
                try:
                    found = ask(name, namespace)
                except Exception:  # noqa: BLE001, S112 - the node left since; the classes of its errors differ by version
                    continue
                has.update((role, topic, kind) for topic, kinds in found for kind in kinds)
            listed[full] = (times, frozenset(has))
        return listed

    def _ask(self, topic: str) -> None:
        ends: list[Endpoint] = []
        for role, ask in (
            (Role.PUBLISHER, self._node.get_publishers_info_by_topic),
            (Role.SUBSCRIPTION, self._node.get_subscriptions_info_by_topic),
        ):
            for info in ask(topic):
                if info.node_name.startswith(_UNKNOWN):
                    self._again.add(topic)
                    continue
                end = _endpoint(role, topic, info)
                if end.node.startswith(OWN):
                    self._own_host = host_bits(end.gid)
                    self._own.add(end.gid)
                    continue
                ends.append(end)
                self._names[end.gid] = end.node
        for end in set(self._ends.get(topic, ())) - set(ends):
            self._names.pop(end.gid, None)
        self._ends[topic] = tuple(sorted(ends, key=lambda end: (end.role.value, end.node, end.gid)))

    def _whole(self) -> Graph:
        if not self._own_host:
            self._ask("/parameter_events")
        prefixes: dict[str, set[str]] = {}
        for ends in self._ends.values():
            for end in ends:
                prefixes.setdefault(end.node, set()).add(prefix(end.gid))
        self._resolve(prefixes)
        self._dead &= {key for keys in prefixes.values() for key in keys}
        nodes = [
            self._place(name, prefixes.get(name, set()) - self._dead)
            for name in self._listed
            if not prefixes.get(name) or prefixes[name] - self._dead
        ]
        there = {node.name for node in nodes}
        ends_there = [end for ends in self._ends.values() for end in ends if prefix(end.gid) not in self._dead]
        services = [
            Endpoint(name, role, topic, kind)
            for name, (_, has) in self._listed.items()
            if name in there
            for role, topic, kind in has
            if role in (Role.SERVICE_SERVER, Role.SERVICE_CLIENT)
        ]
        if self._lifecycles is not None:
            self._lifecycles.follow(services)
        return Graph(
            "ros2",
            tuple(sorted(nodes)),
            tuple(sorted(_with_actions([*ends_there, *services]), key=lambda e: (e.node, e.role.value, e.name, e.gid))),
            (self._host,),
            tuple(
                sorted(
                    {
                        Process(self._host, found.pid, found.command, found.started)
                        for key, found in self._found.items()
                        if key not in self._dead
                    }
                )
            ),
        )

    def _resolve(self, prefixes: dict[str, set[str]]) -> None:
        nodes_of: dict[str, set[str]] = {}
        for name, keys in prefixes.items():
            for key in keys:
                nodes_of.setdefault(key, set()).add(name.rpartition("/")[2])
        self._found = {key: found for key, found in self._found.items() if key in nodes_of}
        self._tries = Counter({key: tries for key, tries in self._tries.items() if key in nodes_of})
        for key in sorted(nodes_of.keys() - self._found.keys()):
            bits = pid_bits(key)
            if bits is None or host_bits(key) != self._own_host or self._tries[key] >= _TRIES:
                continue
            self._tries[key] += 1
            found = self._find(bits, frozenset(nodes_of[key]))
            if found is not None:
                self._found[key] = found

    def _place(self, name: str, prefixes: set[str]) -> Node:
        found = {self._found[key] for key in prefixes if key in self._found}
        local = any(host_bits(key) == self._own_host for key in prefixes)
        # A name that several processes bear has no process of its own.
        one = found.pop() if len(found) == 1 else None
        state = self._lifecycles.state(name) if self._lifecycles else ""
        return Node(name, self._host if local else "", one.pid if one else 0, one.proofs if one else (), state)


def _changed(before: Listed, after: Listed) -> Iterable[str]:
    for name in before.keys() | after.keys():
        old, new = before.get(name, (0, frozenset())), after.get(name, (0, frozenset()))
        if old == new:
            continue
        several = old[0] != new[0] and before.get(name) and after.get(name)
        for role, topic, _ in old[1] | new[1] if several else old[1] ^ new[1]:
            if role in (Role.PUBLISHER, Role.SUBSCRIPTION):
                yield topic


def _full(name: str, namespace: str) -> str:
    return f"{namespace.rstrip('/')}/{name}"


def _endpoint(role: Role, topic: str, info: Any) -> Endpoint:
    text = str(getattr(info, "topic_type_hash", ""))
    return Endpoint(
        _full(info.node_name, info.node_namespace),
        role,
        topic,
        info.topic_type,
        text if text.startswith("RIHS") else "",
        qos_of(info.qos_profile),
        text_of(info.endpoint_gid),
    )


def qos_of(profile: Any) -> Qos:
    """Return a profile of rclpy in our words."""
    return Qos(
        _policy(profile.reliability, "reliable", "best_effort"),
        _policy(profile.durability, "volatile", "transient_local"),
        _policy(profile.history, "keep_last", "keep_all"),
        profile.depth,
        _seconds(profile.deadline),
        _seconds(profile.lifespan),
        _policy(profile.liveliness, "automatic", "manual_by_topic"),
        _seconds(profile.liveliness_lease_duration),
    )


def _policy(value: Any, *known: str) -> str:
    name = value.name.lower()
    return name if name in known else ""


def _seconds(duration: Any) -> float:
    value: float = duration.nanoseconds * 1e-9
    return value if value < _FOREVER_S else 0.0


def _with_actions(ends: list[Endpoint]) -> Iterator[Endpoint]:
    """Yield the services that make an action as one endpoint of the action; its topics stay, for they have traffic."""
    actions = {(end.node, end.role, end.name.removesuffix(_ACTION)) for end in ends if end.name.endswith(_ACTION)}
    for end in ends:
        action, hidden, _ = end.name.partition(_HIDDEN)
        role = _ROLES.get(end.role)
        if role is None or not hidden or (end.node, end.role, action) not in actions:
            yield end
        elif end.name.endswith(_ACTION):
            yield Endpoint(end.node, role, action, end.type.removesuffix(_GOAL))
