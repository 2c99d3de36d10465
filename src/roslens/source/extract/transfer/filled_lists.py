"""How many items a list of C++ has that its function fills alone: ``words.push_back(argv[i])``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.kinds import known_text, object_of
from roslens.source.extract.domain.parameter_types import VECTOR
from roslens.source.extract.ir.program import Assign, Call, Expression, Function, Lambda, Member, Name
from roslens.source.extract.transfer.plugin_held import held_in

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_SIZES = frozenset({"size", "length"})
_FILLS = frozenset({"push_back", "emplace_back"})


def count_of_filled(ctx: Context, end: Expression) -> int:
    """Return the number of items where a loop counts to the size of a list of which each is known; 0 else.

    The list is a variable of the function that is evaluated, and nothing but ``push_back`` changes it there.
    """
    match end:
        case Call(function=Member(of=Name() as place, name=name), arguments=()) if name in _SIZES and ctx.stack.calls:
            thing = object_of(ctx.state.frame.names.get(place.name))
        case _:
            return 0
    if thing is None or thing.type != VECTOR:
        return 0
    held = held_in(thing)
    known = all(known_text(one) is not None for one in held.values())
    return len(held) if held and known and None not in held and _filled_here(ctx.stack.calls[-1][1], place) else 0


def _filled_here(function: Function, name: Name) -> bool:
    """Whether a function declares a list without items, and does not pass it on."""
    declared = False
    waiting: list[object] = [function.body]
    while waiting:
        one = waiting.pop()
        match one:
            case tuple():
                waiting += one
            case Lambda():
                return False
            case Assign() if one.target == name:
                if one.value is not None:
                    return False
                declared = True
            case Call(function=Member(of=of, name=method)) if of == name:
                if method not in (*_FILLS, *_SIZES, "empty", "at"):
                    return False
                waiting.append(one.arguments)
            case Call() if name in one.arguments:
                return False
            case msgspec.Struct():
                waiting += [getattr(one, field) for field in one.__struct_fields__]
    return declared
