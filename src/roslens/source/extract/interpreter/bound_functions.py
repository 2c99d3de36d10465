"""Functions bound to their objects: ``std::bind(&A::f, this, _1)``, ``functools.partial(f, 1)``."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Callable, Obj, Unknown, Value
from roslens.source.extract.domain.kinds import name_of


def bound(arguments: list[Value]) -> Value:
    """Return the function that is the first of the arguments, bound to the others."""
    match arguments:
        case [Callable() as function, Obj() as thing, *rest] if function.function.class_name:
            return Callable(function.function, function.path, thing, function.names, _given(rest))
        case [Callable() as function, *rest]:
            return Callable(function.function, function.path, function.self, function.names, _given(rest))
        case [first, *_] if first is not None:
            return first
    return Unknown("a bound function")


def _given(arguments: list[Value]) -> tuple[Value, ...]:
    """Return arguments without placeholders: ``_1``, ``std::placeholders::_1``."""
    return tuple(one for one in arguments if not name_of(one).rpartition(".")[2].startswith("_"))
