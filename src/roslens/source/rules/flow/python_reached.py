"""What callbacks of a file reach in other files of its package, and which facts tell that a function is reached.

A file says by name what its callbacks call and it does not define: a method of a base class, of an object of an
imported class, an imported function. A hit in another file counts where one of the functions from which it is reached
is named. Only callbacks in the default group of their node are followed: whether others keep something back is not
known in the other file.
"""

from __future__ import annotations

import builtins
from collections.abc import Iterator, Sequence
from typing import cast

from tree_sitter import Node

from roslens.source.rules.calls import function_around, keywords
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.flow.python_callbacks import python_callbacks
from roslens.source.rules.flow.python_functions import PythonClass, PythonFunctions, python_functions
from roslens.source.rules.flow.summary import LONGEST_WAY, CallbackKind
from roslens.source.rules.hit import EITHER

REACHED = "reached "
"""Before a fact: ``reached Class.method``, ``reached function``."""

_GROUPLESS = frozenset({CallbackKind.DONE, CallbackKind.EXECUTE, CallbackKind.FEEDBACK})
_BUILTINS = frozenset(dir(builtins))
_MOST = 12
"""Functions from which one place may be reached; of more, the first are asked about."""


def reached_facts(view: FileView) -> tuple[str, ...]:
    """Return what callbacks of a file call that other files define, sorted."""
    callbacks = python_callbacks(view) if view.syntax == "python" else None
    if callbacks is None:
        return ()
    found: set[str] = set()
    for one in callbacks.unfollowed:
        found.update(_outside(one, callbacks.functions, view))
    for registration in callbacks.registrations:
        is_default = "callback_group" not in keywords(registration.call, view)
        if is_default and not registration.is_ros1 and registration.kind not in _GROUPLESS:
            for function in callbacks.reached_from(registration):
                found.add(_name(function, view))
                found.update(_called_outside(function, callbacks.functions, view))
    return tuple(sorted(REACHED + name for name in found if name))


def _called_outside(function: Node, functions: PythonFunctions, view: FileView) -> Iterator[str]:
    for call in functions.calls_in(function):
        callee = call.child_by_field_name("function")
        if callee is not None and not functions.called(call):
            yield from _outside(callee, functions, view)


def where_reached(node: Node, view: FileView) -> str:
    """Return the facts of which one tells that a place is reached, for a hit; empty outside of functions."""
    around = function_around(node)
    if around is None or around.type != "function_definition":
        return ""
    names = [_name(one, view) for one in _callers(around, view)]
    return EITHER.join(REACHED + name for name in dict.fromkeys(names[:_MOST]) if name)


def _outside(callee: Node, functions: PythonFunctions, view: FileView) -> Iterator[str]:
    """Yield the names by which another file may define what an expression means."""
    if callee.type == "identifier":
        name = view.text(callee)
        if name not in _BUILTINS and not name[:1].isupper() and not functions.defines(name):
            yield name
        return
    of = callee.child_by_field_name("object") if callee.type == "attribute" else None
    method = view.text(callee.child_by_field_name("attribute"))
    if of is None or not method.isidentifier():
        return
    for name in _outside_classes(of, functions, view):
        yield f"{name}.{method}"


def _outside_classes(of: Node, functions: PythonFunctions, view: FileView) -> Sequence[str]:
    """Return the names of classes of other files that an object has, or that its class is derived from."""
    if functions.is_self(of):
        around = functions.class_around(of)
        return [] if around is None else [one.rpartition(".")[2] for one in _outer_bases(around, functions, 0)]
    made = (one.child_by_field_name("function") for one in functions.values(of) if one.type == "call")
    names = [view.text(one).rpartition(".")[2] for one in made if one is not None]
    return [one for one in names if one[:1].isupper() and one not in functions.classes]


def _outer_bases(of: PythonClass, functions: PythonFunctions, depth: int) -> Iterator[str]:
    for base in of.bases if depth < LONGEST_WAY else ():
        inner = functions.classes.get(base)
        if inner is None:
            yield base
        elif inner is not of:
            yield from _outer_bases(inner, functions, depth + 1)


def _callers(function: Node, view: FileView) -> Sequence[Node]:
    """Return a function and the functions of the file that call it, directly or through others."""
    known = cast("dict[int, list[Node]] | None", view.kept.get(_callers))
    if known is None:
        known = {}
        view.kept[_callers] = known
        functions = python_functions(view)
        for one in functions.functions:
            for callee in functions.callees(one):
                known.setdefault(callee.id, []).append(one)
    found, last = [function], [function]
    for _ in range(LONGEST_WAY):
        last = [one for each in last for one in known.get(each.id, ()) if one not in found]
        found.extend(dict.fromkeys(last))
    return found


def _name(function: Node, view: FileView) -> str:
    name = view.text(function.child_by_field_name("name"))
    around = above(function, "class_definition", "function_definition")
    if around is not None and around.type == "class_definition":
        return f"{view.text(around.child_by_field_name('name'))}.{name}"
    return name
