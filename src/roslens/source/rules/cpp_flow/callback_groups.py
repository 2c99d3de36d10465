"""Which callback groups a file of rclcpp makes, and who is in them: clients, and functions that are registered."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple, cast

from roslens.source.rules.callbacks import REGISTERING_CPP, callee_name
from roslens.source.rules.calls import call_at
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.file_view import FileView

_MADE = re.compile(r"\b(\w+)\s*=\s*[^;=]*?\bcreate_callback_group\s*\(([^;]*)\)")
_PUT = re.compile(r"\b(\w+)\s*(?:\.|->)\s*callback_group\s*=\s*(?:this->)?(\w+)\s*;")
_ONE_THREAD = re.compile(rb"\brclcpp::spin(?:_some|_all)?\s*\(|\bSingleThreadedExecutor\b")
_MANY_THREADS = re.compile(rb"MultiThreaded|EventsExecutor|\w+Executor\b(?<!SingleThreadedExecutor)")
_PLAIN = re.compile(
    rb"(?:\bpublic\s+|[:,]\s*)(?:rclcpp::|rclcpp_lifecycle::|nav2_util::)(?:Lifecycle)?Node\b"
    rb"|[:,]\s*(?:Lifecycle)?Node\s*[({]|make_shared<\s*(?:rclcpp|rclcpp_lifecycle)::(?:Lifecycle)?Node\s*>"
    rb"|\bNode::make_shared\b"
)
_WORD = re.compile(r"\w+")
DEFAULT = ""
"""The group of whatever is given none: mutually exclusive, one for each node."""
_Named = Mapping[str, frozenset[str]]


class Groups(NamedTuple):
    """The callback groups of a file.

    Attributes:
        reentrant: names of groups in which several callbacks run at once.
        exclusive: names of the others.
        options: the group that options with a name put what they are given to into.
    """

    reentrant: frozenset[str]
    exclusive: frozenset[str]
    options: Mapping[str, str]

    def named_in(self, text: str) -> str:
        """Return the group that a call puts what it makes into; the default one where it names none."""
        words = set(_WORD.findall(text))
        for name in (*self.reentrant, *self.exclusive):
            if name in words:
                return name
        return next((group for option, group in sorted(self.options.items()) if option in words), DEFAULT)


def groups_of(view: FileView) -> Groups:
    """Return the callback groups that a file makes."""
    found = view.kept.get("callback groups")
    if found is None:
        code = view.code.decode("utf-8", "replace") if b"callback_group" in view.code else ""
        made = [(match[1], "Reentrant" in match[2]) for match in _MADE.finditer(code)]
        found = view.kept["callback groups"] = Groups(
            frozenset(name for name, is_reentrant in made if is_reentrant),
            frozenset(name for name, is_reentrant in made if not is_reentrant),
            {match[1]: match[2] for match in _PUT.finditer(code)},
        )
    return cast("Groups", found)


def one_thread(view: FileView) -> bool:
    """Return whether a file runs its node in one thread: it spins, and names no other executor."""
    return view.has(_ONE_THREAD) and not view.has(_MANY_THREADS)


def is_plain_node(view: FileView) -> bool:
    """Return whether the node of a file is one of rclcpp itself: other base classes may put clients into own groups."""
    return view.has(_PLAIN)


def group_of_callback(callback: str, view: FileView) -> str | None:
    """Return the group in which a function is called; None where the file does not register it, or in several."""
    return _only(_registered(view).get(callback.rpartition("::")[2], frozenset()))


def group_of_client(client: str, view: FileView) -> str | None:
    """Return the group of a client by its name; None where the file does not make it."""
    return _only(_clients(view).get(client, frozenset()))


def _only(found: frozenset[str]) -> str | None:
    return next(iter(found)) if len(found) == 1 else None


def _registered(view: FileView) -> _Named:
    found = view.kept.get("groups of callbacks")
    if found is None:
        groups, named = groups_of(view), dict[str, set[str]]()
        for text in _registrations(view):
            for each in set(_WORD.findall(text)):
                named.setdefault(each, set()).add(groups.named_in(text))
        found = view.kept["groups of callbacks"] = {name: frozenset(each) for name, each in named.items()}
    return cast("_Named", found)


def _registrations(view: FileView) -> Iterator[str]:
    """Yield the calls that register callbacks, as they are written."""
    for name in sorted(REGISTERING_CPP):
        word = name.encode()
        for at in word_places(word, view) if word in view.words else ():
            node = view.node_at(at, at + len(word))
            call = call_at(node) if node is not None else None
            if call is not None and callee_name(call, view) == name:
                yield view.text(call)


_CLIENT = re.compile(r"\b(\w+)\s*=\s*([^;=]*?)\b(?:create_client)\s*(?:<[^;()]*?>)?\s*(\([^;]*\))\s*;")


def _clients(view: FileView) -> _Named:
    found = view.kept.get("groups of clients")
    if found is None:
        groups, named = groups_of(view), dict[str, set[str]]()
        for match in _CLIENT.finditer(view.code.decode("utf-8", "replace")):
            named.setdefault(match[1], set()).add(groups.named_in(match[3]))
        found = view.kept["groups of clients"] = {name: frozenset(each) for name, each in named.items()}
    return cast("_Named", found)
