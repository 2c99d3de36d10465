"""From which callback a place in C++ is reached within one file: directly, or through helpers and lambdas.

A helper is followed to the calls of it by its plain name or by ``this->``, in methods of the same class or in free
functions. What runs in a thread of its own, or is handed over to something unknown, is not followed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple, cast

from tree_sitter import Node

from roslens.source.rules.callbacks import REGISTERING_CPP, callback_around, callbacks_of, callee_name, function_name
from roslens.source.rules.calls import call_at, receiver
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_flow.local_lambda import uses_of, variable_of
from roslens.source.rules.file_view import FileView, above, all_above

_MOST_HELPERS = 4
_MOST_CALLS = 12
_AT_ONCE = frozenset(
    (
        *("for_each", "find_if", "any_of", "all_of", "none_of", "count_if", "transform", "sort", "stable_sort"),
        *("remove_if", "erase_if", "accumulate", "generate", "call_once", "invoke", "apply", "visit"),
    )
)
"""What calls the function that it gets before it returns."""
_FUNCTIONS = ("function_definition", "lambda_expression")


class Chain(NamedTuple):
    """How a place is reached.

    Attributes:
        callback: as of :func:`~roslens.source.rules.callbacks.callback_around`: the function that has to be a callback,
            empty where it certainly is one.
        helpers: names of the functions and lambdas between the callback and the place, the innermost first.
        calls: the calls of them, in the same order.
    """

    callback: str
    helpers: tuple[str, ...] = ()
    calls: tuple[Node, ...] = ()

    @property
    def through(self) -> str:
        """What to add to a message on the way: empty where the place stands in the callback itself."""
        if not self.helpers:
            return ""
        return f", through {' and '.join(f'`{one}`' for one in self.helpers)}"


def _always(_node: Node) -> bool:
    return True


def chain_to(node: Node, view: FileView, follows: Callable[[Node], bool] = _always) -> Chain | None:
    """Return how a node is reached from a callback; the one that is certain if there is any.

    Args:
        node: the place.
        view: the file.
        follows: whether the way goes on through a call: not where what happens below does no harm above.
    """
    possible: Chain | None = None
    for chain in _chains(node, view, follows):
        if not chain.callback or chain.callback in _registered(view):
            return chain
        possible = possible or chain
    return possible


def _registered(view: FileView) -> frozenset[str]:
    found = view.kept.get("registered callbacks")
    if found is None:
        found = view.kept["registered callbacks"] = frozenset(callbacks_of(view))
    return cast("frozenset[str]", found)


def _chains(node: Node, view: FileView, follows: Callable[[Node], bool]) -> Iterator[Chain]:
    waiting: list[tuple[Node, Chain]] = [(node, Chain(""))]
    seen: set[int] = set()
    while waiting:
        place, way = waiting.pop(0)
        function = next((one for one in all_above(place) if one.type in _FUNCTIONS), None)
        if function is None or function.start_byte in seen:
            continue
        seen.add(function.start_byte)
        yield from _ends(place, function, way, view)
        if len(way.helpers) < _MOST_HELPERS:
            waiting += (
                (call, _longer(way, helper, call)) for call, helper in _calls_of(function, view) if follows(call)
            )


def _ends(place: Node, function: Node, way: Chain, view: FileView) -> Iterator[Chain]:
    """Yield the ways that end in the function around a place."""
    callback = callback_around(place, view)
    if callback is not None:
        yield Chain(callback, way.helpers, way.calls)
    if function.type == "lambda_expression":
        yield from _of_lambda(function, way, view)


def _longer(way: Chain, helper: str, call: Node) -> Chain:
    return Chain("", (*way.helpers, helper) if helper else way.helpers, (*way.calls, call))


def _of_lambda(function: Node, way: Chain, view: FileView) -> Iterator[Chain]:
    """Yield the registration of a lambda by the variable that holds it."""
    for use in uses_of(function, view):
        listed = use.parent
        call = above(use, "call_expression", "compound_statement")
        is_given = listed is not None and listed.type == "argument_list" and call == listed.parent
        if is_given and call is not None and callee_name(call, view) in REGISTERING_CPP:
            yield Chain("", way.helpers, way.calls)


def _calls_of(function: Node, view: FileView) -> Iterator[tuple[Node, str]]:
    """Yield where a function or lambda is called in the file, with its name, which a lambda called at once lacks."""
    if function.type == "lambda_expression":
        yield from _calls_of_lambda(function, view)
        return
    qualified = function_name(function, view)
    of_class, _, name = qualified.rpartition("::")
    if not name.isidentifier() or name == of_class.rpartition("::")[2]:
        return
    count = 0
    for at in word_places(name.encode(), view):
        word = view.node_at(at, at + len(name))
        call = call_at(word) if word is not None else None
        if call is None or function.start_byte <= at < function.end_byte or not _is_own(call, name, view):
            continue
        if of_class and _class_of(call, view) != of_class.rpartition("::")[2]:
            continue
        count += 1
        if count > _MOST_CALLS:
            return
        yield call, qualified


def _is_own(call: Node, name: str, view: FileView) -> bool:
    """Return whether a call is one of a function by its plain name or by ``this->``."""
    of = receiver(call)
    if of is not None:
        return view.text(of) == "this"
    return view.text(call.child_by_field_name("function")).partition("<")[0] == name


def _class_of(node: Node, view: FileView) -> str:
    definition = above(node, "function_definition")
    return function_name(definition, view).rpartition("::")[0].rpartition("::")[2] if definition is not None else ""


def _calls_of_lambda(function: Node, view: FileView) -> Iterator[tuple[Node, str]]:
    around = function.parent
    if around is not None and around.type == "call_expression" and around.child_by_field_name("function") == function:
        yield around, ""
    call = around.parent if around is not None and around.type == "argument_list" else None
    if call is not None and call.type == "call_expression" and callee_name(call, view) in _AT_ONCE:
        yield call, ""
    name = variable_of(function, view)
    for use in uses_of(function, view):
        called = call_at(use)
        if called is not None:
            yield called, name
