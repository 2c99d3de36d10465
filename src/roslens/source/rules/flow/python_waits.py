"""Where code of Python that waits or sleeps runs: in a callback, or in a function that a callback of the file calls."""

from __future__ import annotations

import re

import msgspec
from tree_sitter import Node

from roslens.source.rules.callbacks import callback_around, runs_once, spoken
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_callbacks import ways_to
from roslens.source.rules.flow.spoken_way import spoken_way
from roslens.source.rules.flow.summary import CallbackKind, Way

_STREAMS = frozenset({CallbackKind.SUBSCRIPTION, CallbackKind.TIMER, CallbackKind.OTHER})


class WhereItWaits(msgspec.Struct, frozen=True):
    """A place in a callback.

    Attributes:
        spoken: of it, for a message.
        callback: of a hit there: the function that some file has to register; empty where this file does.
        takes_time: goals of an action are carried out there: to take its time is what it is for.
    """

    spoken: str
    callback: str
    takes_time: bool


def where_it_waits(node: Node, view: FileView) -> WhereItWaits | None:
    """Return where code that waits runs; None outside of callbacks.

    rospy runs services and actions in threads of their own: of it only subscriptions and timers count.
    """
    of_stream = b"rclpy" not in view.code
    for way in ways_to(node, view):
        if _holds_up(way, view, of_stream=of_stream):
            # A callback may be registered as more than what it is found to be first.
            kinds = {one.registration.kind for one in ways_to(node, view)}
            return WhereItWaits(spoken_way(way, view), "", CallbackKind.EXECUTE in kinds)
    if ways_to(node, view):
        return None
    callback = callback_around(node, view, of_stream=of_stream)
    return None if callback is None else WhereItWaits(spoken(callback), callback, _executes(callback, view))


def _holds_up(way: Way, view: FileView, *, of_stream: bool) -> bool:
    if of_stream and way.registration.kind not in _STREAMS:
        return False
    return not (way.registration.kind in _STREAMS and any(runs_once(one, view) for one in way.functions))


def _executes(callback: str, view: FileView) -> bool:
    """Return whether a callback carries out goals of an action."""
    name = callback.rpartition(".")[2].encode()
    given = (
        rb"\bActionServer\s*\((?:[^()=]*,|[^()]*\bexecute_callback\s*=)\s*(?:self\s*\.\s*)?" + re.escape(name) + rb"\b"
    )
    return bool(name) and re.search(given, view.code) is not None
