"""Calls that make an endpoint, by the names of what is called."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from msgspec.structs import astuple

from roslens.source.extract.ir.program import Call, Expression, Function, Lambda, Literal, Member, Name, Opaque

MAKE = frozenset(
    {"create_publisher", "create_subscription", "create_generic_publisher", "create_generic_subscription",
      "create_service", "create_client", "create_wall_timer", "advertise",
     "subscribe", "advertiseService", "serviceClient", "create_action_server", "create_action_client", "Publisher",
     "Subscriber", "ServiceProxy", "create_server", "ActionClient", "ActionServer", "advertiseCamera",
     "subscribeCamera", "SimpleActionClient", "SimpleActionServer", "RealtimePublisher", "InteractiveMarkerServer"}
)  # fmt: skip
_LEAVES = frozenset({str, int, float, bool, type(None), Literal, Name, Opaque, Lambda})
"""What holds no call."""
STEMS = (b"create_", b"dvertise", b"ubscribe", b"Publisher", b"ervice", b"Client", b"Server")
"""Some of these letters are in each name of :data:`MAKE`: to find them takes a tenth of looking at each call."""
_ROSPY = Name("rospy")
_encode = msgspec.msgpack.Encoder().encode


def makes_endpoints(function: Function) -> bool:
    """Whether a function calls something that makes an endpoint, by its name."""
    return next(calls_that_make(function.initialisers, function.body), None) is not None


def calls_that_make(*parts: object) -> Iterator[Call]:
    """Yield the calls in parts of a program that make an endpoint, by their name."""
    if not _may_make(parts):
        return
    waiting: list[object] = [*parts]
    while waiting:
        one = waiting.pop()
        match one:
            case tuple():
                waiting += [part for part in one if type(part) not in _LEAVES]
            case msgspec.Struct():
                if isinstance(one, Call) and _is_named(one.function):
                    yield one
                waiting += [part for part in astuple(one) if type(part) not in _LEAVES]


def _may_make(parts: tuple[object, ...]) -> bool:
    try:
        written = _encode(parts)
    except OverflowError:
        # A number of more than 64 bits cannot be encoded.
        return True
    return any(stem in written for stem in STEMS)


def _is_named(called: Expression) -> bool:
    if not isinstance(called, Name | Member):
        return False
    name = called.name.rpartition(".")[2]
    return name in MAKE or (name == "Service" and isinstance(called, Member) and called.of == _ROSPY)
