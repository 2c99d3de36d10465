"""Whether a callback that waits keeps back what it waits for: nodes, callback groups and executors of rclpy.

rclpy/node.py gives whatever names no group the default group of its node, which is mutually exclusive;
rclpy/executors.py runs one callback of such a group at a time. ``rclpy.spin`` runs all callbacks in one thread, unless
it is given an executor.
"""

from __future__ import annotations

import re
from enum import Enum

import msgspec
from tree_sitter import Node

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.calls import arguments, keywords, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_callbacks import ways_to
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.summary import CallbackKind, Registration, Way

_MULTI = frozenset({b"MultiThreadedExecutor", b"AsyncIOExecutor"})
_SPINS = re.compile(rb"\brclpy\s*\.\s*spin\s*\(\s*[\w.]+(?:\(\s*\))?\s*\)|\bSingleThreadedExecutor\s*\(")
_NODES = re.compile(r"(?:^|\.)(?:self|_?\w*node_?)$", re.IGNORECASE)
_MAKES_NODES = ("create_node", "Node")
_GROUPLESS = frozenset({CallbackKind.DONE, CallbackKind.EXECUTE, CallbackKind.FEEDBACK})
"""What rclpy runs as tasks of the executor, outside of all groups."""


class _GroupKind(str, Enum):
    EXCLUSIVE = "exclusive"
    REENTRANT = "reentrant"
    UNKNOWN = "unknown"


class _Group(msgspec.Struct, frozen=True):
    """A callback group: the same key is the same group."""

    kind: _GroupKind
    key: str


class Blocked(msgspec.Struct, frozen=True):
    """Why what a callback waits for cannot come.

    Attributes:
        because: in words.
        certainty: of it.
    """

    because: str
    certainty: Certainty


def is_single_threaded(view: FileView) -> bool:
    """Return whether the file spins nodes in one thread."""
    return _MULTI.isdisjoint(view.words) and view.has(_SPINS)


def blocked(registration: Registration, made: Node, view: FileView) -> Blocked | None:
    """Return why a callback that waits keeps back what an object needs, None where nothing is known to.

    Args:
        registration: of the callback.
        made: the call that makes the object: a client, a subscription, an action client.
        view: of the file.
    """
    here, there = _node_of(registration.call, view), _node_of(made, view)
    if not here or not there or b"default_callback_group" in view.code:
        return None
    if here != there and not _may_be_same(here, there, view):
        return None
    if registration.kind in _GROUPLESS:
        return _by_one_thread(view)
    own, other = _group_of(registration.call, here, view), _group_of(made, there, view)
    if own == other and own.kind is _GroupKind.EXCLUSIVE:
        certainty = Certainty.PROVEN if here == there else Certainty.LIKELY
        return Blocked("both are in one mutually exclusive callback group", certainty)
    return _by_one_thread(view)


def _by_one_thread(view: FileView) -> Blocked | None:
    if is_single_threaded(view):
        return Blocked("one thread runs all callbacks here", Certainty.LIKELY)
    return None


def made_by(node: Node, names: frozenset[str], view: FileView) -> Node | None:
    """Return the one call of some functions whose result an expression holds."""
    found = []
    for value in python_functions(view).values(node):
        if value.type != "call":
            if value.type != "none":
                return None
            continue
        if view.text(value.child_by_field_name("function")).rpartition(".")[2] not in names:
            return None
        found.append(value)
    return found[0] if found else None


def _node_of(call: Node, view: FileView) -> str:
    """Return the expression that names the node for which a call makes something; empty where none does."""
    name = view.text(call.child_by_field_name("function")).rpartition(".")[2]
    if name in ("ActionServer", "ActionClient"):
        given = keywords(call, view).get("node") or next(iter(arguments(call)), None)
        return view.text(given)
    if name in ("add_done_callback", "send_goal_async"):
        return _node_of_task(call, view)
    return view.text(receiver(call))


def _node_of_task(call: Node, view: FileView) -> str:
    """Return the node whose client made a future: callbacks of futures run in the executor of that."""
    around = python_functions(view).class_around(call)
    return "self" if around is not None else ""


def _may_be_same(here: str, there: str, view: FileView) -> bool:
    if not _NODES.search(here) or not _NODES.search(there):
        return False
    return not any(_is_other_node(one, view) for one in (here, there))


def _is_other_node(text: str, view: FileView) -> bool:
    """Tell whether a name is given a node that is made in this file, beside the one that is ``self``."""
    name = re.escape(text.encode())
    pattern = rb"(?<![\w.])" + name + rb"\s*(?::[^=\n]*)?=\s*[\w.]*\b(?:create_node|Node)\s*\("
    return re.search(pattern, view.code) is not None


def _group_of(call: Node, node: str, view: FileView) -> _Group:
    given = keywords(call, view).get("callback_group")
    if given is None or given.type == "none":
        unknown = "**" in keywords(call, view)
        return _Group(_GroupKind.UNKNOWN if unknown else _GroupKind.EXCLUSIVE, f"default of {_last(node)}")
    made = [one for one in python_functions(view).values(given) if one.type != "none"]
    texts = {view.text(one.child_by_field_name("function")) for one in made if one.type == "call"}
    if len(made) != 1 or len(texts) != 1:
        return _Group(_GroupKind.UNKNOWN, str(given.id))
    text = texts.pop().rpartition(".")[2]
    if text == "ReentrantCallbackGroup":
        return _Group(_GroupKind.REENTRANT, str(made[0].id))
    if text == "MutuallyExclusiveCallbackGroup":
        return _Group(_GroupKind.EXCLUSIVE, str(made[0].id))
    return _Group(_GroupKind.UNKNOWN, str(given.id))


def _last(node: str) -> str:
    """Return one name for what may be one node."""
    return "node" if _NODES.search(node) else node


def deadlock_of(node: Node, made: Node, view: FileView) -> tuple[Way, Blocked] | None:
    """Return the way to code that waits for an object, from a callback that keeps that back, and why it does."""
    found = [
        (way, blocked(way.registration, made, view)) for way in ways_to(node, view) if not way.registration.is_ros1
    ]
    certain = sorted(((way, why) for way, why in found if why is not None), key=lambda one: -one[1].certainty.rank)
    return certain[0] if certain else None
