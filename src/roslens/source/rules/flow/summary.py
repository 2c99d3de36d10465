"""Registered callbacks and what is reached from them by calls: the terms in which rules ask about flow.

The terms are the same for all languages; what fills them follows the names of one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import Enum

import msgspec
from tree_sitter import Node

LONGEST_WAY = 6
"""Functions between a callback and what it reaches; further on, conditions decide more than calls do."""


class CallbackKind(str, Enum):
    """What calls a function that is handed over."""

    SUBSCRIPTION = "subscription"
    TIMER = "timer"
    SERVICE = "service"
    PARAMETERS = "parameters"
    EXECUTE = "execute"
    GOAL = "goal"
    CANCEL = "cancel"
    ACCEPTED = "accepted"
    FEEDBACK = "feedback"
    DONE = "done"
    OTHER = "other"


class Target(msgspec.Struct, frozen=True, eq=False):
    """A function that an expression means.

    Attributes:
        function: its definition, or a lambda.
        bound: leading arguments that are given already: ``self``, those of ``partial``.
        keywords: arguments by name that are given already.
        is_exact: nothing else can be meant; a decorator or a second value of a variable makes it uncertain.
    """

    function: Node
    bound: int = 0
    keywords: frozenset[str] = frozenset()
    is_exact: bool = True


class Registration(msgspec.Struct, frozen=True, eq=False):
    """A function that is handed over to be called later.

    Attributes:
        kind: what calls it.
        call: which hands it over.
        argument: the expression that is handed over.
        target: the function.
        is_ros1: whether roscpp or rospy calls it.
    """

    kind: CallbackKind
    call: Node
    argument: Node
    target: Target
    is_ros1: bool = False


class Way(msgspec.Struct, frozen=True, eq=False):
    """How a callback reaches a function.

    Attributes:
        registration: of the callback.
        functions: from the callback to the function, both included.
    """

    registration: Registration
    functions: tuple[Node, ...]

    @property
    def is_direct(self) -> bool:
        """Whether the function is the callback itself."""
        return len(self.functions) == 1


def ways(
    registrations: Iterable[Registration], callees: Callable[[Node], Iterable[Node]]
) -> Mapping[int, Sequence[Way]]:
    """Return, by the id of a function, the shortest way to it from each registration that reaches it.

    Args:
        registrations: of callbacks.
        callees: the functions that a function calls and waits for.
    """
    found: dict[int, list[Way]] = {}
    for one in registrations:
        first = one.target.function
        seen = {first.id}
        waiting: list[tuple[Node, ...]] = [(first,)]
        while waiting:
            path = waiting.pop(0)
            found.setdefault(path[-1].id, []).append(Way(one, path))
            if len(path) > LONGEST_WAY:
                continue
            for callee in callees(path[-1]):
                if callee.id not in seen:
                    seen.add(callee.id)
                    waiting.append((*path, callee))
    return found
