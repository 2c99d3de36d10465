"""Functions bound to their objects: ``std::bind(&A::f, this, _1)``, ``functools.partial(f, 1)``."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Callable, Named, Obj, Unknown, Value


def bound(arguments: list[Value]) -> Value:
    """Return the function that is the first of the arguments, bound to the others."""
    function = arguments[0] if arguments else None
    if not isinstance(function, Callable):
        return function if function is not None else Unknown("a bound function")
    rest = arguments[1:]
    thing = function.self
    if function.function.class_name and rest and isinstance(rest[0], Obj):
        thing, rest = rest[0], rest[1:]
    real = tuple(one for one in rest if not (isinstance(one, Named) and one.name.rpartition(".")[2].startswith("_")))
    return Callable(function.function, function.path, thing, function.names, real)
