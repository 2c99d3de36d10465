"""Arguments of calls in a Python launch file: what is given, and which parameter it is for."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from roslens.source.extract.launch_python.python_value import Unknown

_Value = Callable[[ast.expr], Any]


def given(node: ast.Call, value: _Value) -> tuple[list[Any], dict[str, Any]]:
    """Return the arguments of a call by position and by name; what unknown lists would give is left out."""
    positional: list[Any] = []
    for argument in node.args:
        match argument:
            case ast.Starred():
                positional += items_of(value(argument.value)) or []
            case _:
                positional.append(value(argument))
    named: dict[str, Any] = {}
    for keyword in node.keywords:
        found = value(keyword.value)
        if keyword.arg is not None:
            named[keyword.arg] = found
        elif isinstance(found, dict):
            named |= {str(name): one for name, one in found.items()}
    return positional, named


def bound(arguments: ast.arguments, positional: list[Any], named: dict[str, Any], value: _Value) -> dict[str, Any]:
    """Return the values of a function's parameters by name; one that is not given is unknown."""
    every = [*arguments.posonlyargs, *arguments.args]
    defaults = dict(zip(every[len(every) - len(arguments.defaults) :], arguments.defaults, strict=True))
    names: dict[str, Any] = {}
    for index, argument in enumerate(every):
        if index < len(positional):
            names[argument.arg] = positional[index]
        elif argument.arg in named:
            names[argument.arg] = named[argument.arg]
        elif argument in defaults:
            names[argument.arg] = value(defaults[argument])
        else:
            names[argument.arg] = Unknown(f"parameter {argument.arg}")
    for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True):
        names[argument.arg] = named.get(argument.arg, value(default) if default else None)
    if arguments.vararg:
        names[arguments.vararg.arg] = list(positional[len(every) :])
    if arguments.kwarg:
        names[arguments.kwarg.arg] = {name: one for name, one in named.items() if name not in names}
    return names


def items_of(value: Any) -> list[Any] | None:
    """Return what a loop goes through; None where that is unknown."""
    return list(value) if isinstance(value, dict | list | tuple | str) else None
