"""Members that methods set which a loop calls, and that a turn reads before: each turn sees what the one before set."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msgspec.structs import astuple

from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.ir.assigned_names import assigned_names
from roslens.source.extract.ir.program import (
    Assign,
    Branch,
    Call,
    Evaluate,
    Expression,
    Function,
    Lambda,
    Leave,
    Literal,
    Loop,
    Member,
    Name,
    Opaque,
    Operation,
    Return,
    Statement,
)
from roslens.source.extract.symbolic.text import Text, unknown

if TYPE_CHECKING:
    from roslens.source.extract.symbols.symbol_table import Defined
    from roslens.source.extract.transfer.context import Context

_MOST_DEPTH = 3
"""So deep methods that methods call are looked into."""
_SELF = Name("self")
_PLAIN = frozenset({str, int, float, bool, type(None), Literal, Opaque, Lambda, Leave})
_LEAVES = frozenset({*_PLAIN, Name})


def forget_set_by_methods(ctx: Context, statement: Loop) -> None:
    """Let texts and numbers be unknown that methods of the own object set in a turn, and that it reads before.

    What is true or false is left alone: it mostly tells what the first turn did.
    """
    thing = ctx.state.frame.object
    if thing is None or thing.defined is None:
        return
    memo, fields = ctx.index.memo, thing.fields
    known, key = memo.set_in_turns, (id(statement), id(thing.defined.what))
    found = known.get(key)
    if found is None or found[0] is not statement:
        found = known[key] = (statement, _set_by_methods(ctx, thing.defined, statement))
    for name in [name for name in found[1] if name in fields]:
        before = fields[name]
        text = type(before) is Text and before.known
        if not text and type(before) is not int and type(before) is not float:
            continue
        if _order(ctx, thing.defined, (*statement.body, *statement.update), name, _MOST_DEPTH):
            reason = f"{name}, which an iteration of a loop sets"
            fields[name] = unknown(reason) if text else Unknown(reason)


def _set_by_methods(ctx: Context, of: Defined, statement: Loop) -> tuple[str, ...]:
    """Return the members that methods of the object set which a turn calls, and variables of these methods."""
    names: set[str] = set()
    for called in _called_in(statement.body):
        function = _method(ctx, of, called)
        if function is not None:
            names |= assigned_names(function.body)
    return tuple(sorted(names))


def _called_in(body: tuple[Statement, ...]) -> list[str]:
    """Return the methods of the own object that statements call: not those whose results other calls take."""
    found: list[str] = []
    waiting = [*body]
    for one in waiting:
        match one:
            case Evaluate(expression=part) | Assign(value=part) | Return(value=part):
                found += _own_method(part)
            case Branch():
                found += _own_method(one.condition)
                waiting += [*one.then, *one.otherwise]
            case Loop():
                waiting += one.body
    return found


def _own_method(part: Expression | None) -> tuple[str, ...]:
    """Return the method of the own object that an expression calls, itself or as the first call that it computes of."""
    match part:
        case Operation(operands=operands):
            calls = (each for each in operands if type(each) is Call)
            return _own_method(next(calls, None))
        case Call(function=Name(name=name)):
            return (name,)
        case Call(function=Member(of=of, name=name)) if of == _SELF:
            return (name,)
    return ()


def _method(ctx: Context, of: Defined, name: str) -> Function | None:
    known, key = ctx.index.memo.method, (id(of.what), name)
    found = known[key] if key in known else known.setdefault(key, ctx.named.method_of(of, name))
    return found[0] if found is not None and found[0].body else None


def _own_calls(part: Any) -> list[str]:
    """Return the methods of the own object that statements or expressions call, by their names."""
    found: list[str] = []
    waiting: list[Any] = [part]
    for one in waiting:
        kind = type(one)
        if kind is tuple:
            waiting += [each for each in one if type(each) not in _LEAVES]
        elif kind is Call:
            called = one.function
            if type(called) is Name:
                found += [called.name] if "." not in called.name else ()
            elif type(called) is Member and called.of == _SELF:
                found += [called.name]
            else:
                waiting += [called]
            waiting += [one.arguments, one.keywords]
        else:
            waiting += [each for each in astuple(one) if type(each) not in _LEAVES]
    return found


def _order(ctx: Context, of: Defined, body: tuple[Statement, ...], name: str, depth: int) -> bool | None:
    """Return whether a member is read before it is set for sure; None where it is neither."""
    for one in body:
        match one:
            case Assign() if one.operator == "=" and _is_place(one.target, name):
                read = one.value is not None and _says(ctx, of, one.value, name, depth)
                return read is True
            case Branch() | Loop():
                found = _order_of_ways(ctx, of, one, name, depth)
                if found is not None:
                    return found
                continue
        found = _says(ctx, of, one, name, depth)
        if found is not None:
            return found
    return None


def _says(ctx: Context, of: Defined, part: Any, name: str, depth: int) -> bool | None:
    """Return whether an expression or statement reads a member, or calls what does; False where that sets it."""
    if _names(part, name):
        return True
    if not depth:
        return None
    for called in _own_calls(part):
        function = _method(ctx, of, called)
        found = None if function is None else _order(ctx, of, function.body, name, depth - 1)
        if found is not None:
            return found
    return None


def _names(part: Any, name: str) -> bool:
    """Whether an expression or statement names a member of the own object."""
    waiting: list[Any] = [part]
    for one in waiting:
        kind = type(one)
        if kind is Name and one.name == name:
            return True
        if kind is Member and one.name == name and one.of == _SELF:
            return True
        if kind is tuple:
            waiting += [each for each in one if type(each) not in _PLAIN]
        elif kind is not Name and kind not in _PLAIN:
            waiting += [each for each in astuple(one) if type(each) not in _PLAIN]
    return False


def _order_of_ways(ctx: Context, of: Defined, one: Branch | Loop, name: str, depth: int) -> bool | None:
    found = _says(ctx, of, one.head, name, depth)
    if found is not None:
        return found
    ways = [_order(ctx, of, part, name, depth) for part in one.parts]
    if True in ways:
        return True
    match one:
        case Branch() if all(way is False for way in ways):
            return False
    return None


def _is_place(target: Expression, name: str) -> bool:
    return target == Name(name) or target == Member(_SELF, name)
