"""The declared type of what an expression names, where its value does not determine it."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.source.extract.ir.program import (
    Assign,
    Branch,
    Call,
    Expression,
    Function,
    Literal,
    Loop,
    Member,
    Name,
    Operation,
    Statement,
)
from roslens.source.extract.ir.type_names import NUMBER_TYPES, type_name
from roslens.source.extract.symbols.declared_field import declared_field
from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable

_COUNTS = frozenset({"size", "length", "count"})
"""Methods of containers of the standard library that return a number."""
_SAYING_NOTHING = frozenset({"=", ","})
"""Operators of which the type is that of an operand."""


def is_number(index: SymbolTable, function: Function | None, of: Defined | None, expression: Expression) -> bool:
    """Return whether an expression is a number by how it is declared, whatever its value.

    Args:
        index: of the workspace.
        function: in which the expression stands; None outside of functions.
        of: the class of the object that it is called on; None of none.
        expression: whose type is asked for.
    """
    match expression:
        case Operation(operator="?:", operands=(_, *ways)):
            return any(is_number(index, function, of, one) for one in ways)
        case Operation(operator=operator):
            return operator not in _SAYING_NOTHING
        case Literal(value=int()):
            return True
        case Call(function=Member(name=name), arguments=()):
            return name in _COUNTS
        case Name(name=name):
            declared = _of_local(function, name) if function is not None else ""
            declared = declared or declared_field(index, of, name)
        case Member(of=Name(name="self"), name=name):
            declared = declared_field(index, of, name)
        case _:
            return False
    return type_name(declared)[0].removeprefix("std.").rpartition(" ")[2] in NUMBER_TYPES


def _of_local(function: Function, name: str) -> str:
    """Return the type of a parameter or variable of a function; empty where it declares none of that name."""
    for parameter in function.parameters:
        if parameter.name == name:
            return parameter.type
    return _declared_in(function.body, name)


def _declared_in(body: Iterable[Statement], name: str) -> str:
    for statement in body:
        match statement:
            case Assign(target=Name(name=declared), declared=kind) if declared == name and kind:
                return kind
            case Branch(parts=parts) | Loop(parts=parts):
                inside = next(filter(None, (_declared_in(part, name) for part in parts)), "")
                if inside:
                    return inside
    return ""
