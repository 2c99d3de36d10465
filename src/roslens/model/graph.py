"""The computation graph: what is there and what is joined to what. Source, live systems and bags all produce it."""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.model.qos import Qos


class Role(str, Enum):
    """What an endpoint does."""

    PUBLISHER = "publisher"
    SUBSCRIPTION = "subscription"
    SERVICE_SERVER = "service_server"
    SERVICE_CLIENT = "service_client"
    ACTION_SERVER = "action_server"
    ACTION_CLIENT = "action_client"


class Endpoint(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """One end of a topic, service or action.

    Attributes:
        node: resolved name of its node.
        role: what it does.
        name: resolved name of the topic, service or action.
        type: ``package/Type`` (ROS 1) or ``package/msg/Type`` (ROS 2); empty where unknown.
        hash: RIHS01 type hash (ROS 2) or MD5 (ROS 1); empty where unknown.
        qos: of the endpoint; None in ROS 1 or where unknown.
        gid: of the middleware, in hexadecimal; empty where it has none.
        apart: publishers to which a subscription of ROS 1 has no connection, though both run; None where unknown.
    """

    node: str
    role: Role
    name: str
    type: str = ""
    hash: str = ""
    qos: Qos | None = None
    gid: str = ""
    apart: tuple[str, ...] | None = None


class Instance(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """One of several nodes that bear the same name; ``pid`` 0 is unknown, ``context`` is its participant."""

    host: str = ""
    pid: int = 0
    context: str = ""


class Node(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """A node and where it runs.

    ``proofs`` name what shows that the node lives in process ``pid`` on ``host`` (``counters``, ``address``, ``gid``,
    ``processes``, ``api``, ``command line``, ``memory map``, ``started``); ``pid`` 0 is unknown.
    ``lifecycle`` is the state of a managed node. ``instances`` are all nodes of this name where there are several: a
    name is no process then.
    """

    name: str
    host: str = ""
    pid: int = 0
    proofs: tuple[str, ...] = ()
    lifecycle: str = ""
    instances: tuple[Instance, ...] = ()


class Process(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """A process that holds nodes; ``started`` is seconds since the epoch.

    ``nodes`` are those that count their traffic in it, by its own word. ``inner`` is its id as it sees itself, where
    that is another one, as in a container; 0 where it is ``pid``.
    """

    host: str
    pid: int
    command: str = ""
    started: float = 0.0
    nodes: tuple[str, ...] = ()
    inner: int = 0


class Graph(msgspec.Struct, frozen=True, omit_defaults=True):
    """Everything that is there at an instant, each part sorted.

    ``generation`` is ``ros1`` or ``ros2``; ``parameters`` maps a node's name to its parameters as text. ``identities``
    maps a host to the four hexadecimal digits (of each version of the middleware) that identifiers made on it have in
    their third and fourth byte.
    """

    generation: str
    nodes: tuple[Node, ...] = ()
    endpoints: tuple[Endpoint, ...] = ()
    hosts: tuple[str, ...] = ()
    processes: tuple[Process, ...] = ()
    parameters: dict[str, dict[str, str]] = {}
    identities: dict[str, tuple[str, ...]] = {}


class Change(str, Enum):
    """What can happen to a part of the graph."""

    APPEARED = "appeared"
    VANISHED = "vanished"
    RESTARTED = "restarted"
    CHANGED = "changed"
    FLAPPING = "flapping"


class Event(msgspec.Struct, frozen=True, omit_defaults=True):
    """A change of the graph at ``time``, seconds on the monitor's clock; ``entity`` is the text form of an id.

    ``ended`` is how a process that vanished ended, or that of a node which vanished with it
    (`model/acting/process_end.py`); empty where no end of a process was seen. ``said`` are the last lines of its log,
    as far as they could be read.
    """

    time: float
    change: Change
    entity: str
    detail: str = ""
    ended: str = ""
    said: tuple[str, ...] = ()
