"""What the functions of Python do that make lists of lists, and ``std::vector`` of C++."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, Unknown, Value
from roslens.source.extract.domain.guarded import in_place_of, is_counted, unguarded
from roslens.source.extract.domain.kinds import are_of_kind, is_whole, known_text
from roslens.source.extract.domain.parameter_types import ITEM, VECTOR, array_of_cpp
from roslens.source.extract.domain.typed_list import TypedList
from roslens.source.extract.domain.unknown_lists import Each, each_of, number_below
from roslens.source.extract.domain.word_list import Words
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_MOST = 16
"""So many turns of a loop over numbers are followed one by one."""


@outer("enumerate", quiet=True)
def numbered(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Items with their numbers."""
    over, first = called.argument(0), called.argument(1, "start", default=0)
    items = ctx.items(over)
    if items is not None and not is_counted(items):
        return perhaps_numbered(items)
    if items is None:
        return Each([Unknown("a number"), each_of(over)])
    match first:
        case int():
            return [[number + first, one] for number, one in enumerate(items)]
    return [[Unknown("a number"), one] for one in items]


def perhaps_numbered(items: list[Value]) -> list[Value]:
    """Return items with unknown indices, as some of them may be missing."""
    return [in_place_of(one, [Unknown("a number"), unguarded(one)]) for one in items]


@outer("zip", quiet=True)
def side_by_side(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Items of several lists, side by side."""
    lists = [ctx.items(one) for one in called.arguments]
    known = [one for one in lists if one is not None]
    if len(known) == len(lists) and all(map(is_counted, known)):
        return [list(one) for one in zip(*known, strict=False)]
    items = zip(called.arguments, lists, strict=True)
    return Each([each_of(one) if found is None else Unknown("an item of a list") for one, found in items])


@outer("list", "tuple", "set", "frozenset", "reversed", "sorted", quiet=True)
def collected(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A list of the items of another one."""
    if not called.arguments and not called.keywords:
        return []
    over = called.argument(0)
    match over:
        case Words() if called.name in ("list", "tuple"):
            return over.part(None, None)
        case Words():
            return Unknown(f"result of {called.name}()")
        case Each() | Text(known=None):
            return over
    items = ctx.items(over)
    if items is None:
        return Unknown(f"result of {called.name}()")
    if called.name == "reversed":
        return items[::-1]
    if called.name == "sorted":
        texts = [known_text(one) for one in items]
        known = [one for one in texts if one is not None]
        plain = len(known) == len(items) and not called.keywords
        return [Text.of(one) for one in sorted(known)] if plain else Unknown("result of sorted()")
    if called.name.endswith("set") and are_of_kind(items, Text):
        return list(dict.fromkeys(items))
    return list(items)


@outer("range", quiet=True)
def counted(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Numbers in a row."""
    given = [one for one in called.arguments if is_whole(one)]
    if len(called.arguments) == 1 and (number := number_below(called.arguments[0])) is not None:
        return Each(number)
    if not given or len(given) != len(called.arguments) or len(given) > 3 or (len(given) == 3 and not given[2]):
        return Each(Unknown("a number"))
    numbers = range(*given)
    return list(numbers) if len(numbers) <= _MOST else Each(Unknown("a number"))


@outer(VECTOR, "vector", quiet=True)
def vector(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A list of C++; one that is declared without items has unknown content."""
    item = called.templates[0] if called.templates else ""
    first = called.argument(0)
    match first:
        case list():
            kind = array_of_cpp(item)
            reals = kind == "double_array"
            return TypedList((float(one) if reals and type(one) is int else one for one in first), kind)
    if len(called.arguments) == 2 and type(first) is int and 0 <= first <= _MOST:
        return TypedList([called.arguments[1]] * first, array_of_cpp(item))
    if not called.arguments or type(first) is int:
        return Obj(VECTOR, None, {}, None, {ITEM: item})
    return first if len(called.arguments) == 1 else Unknown("result of std.vector()")
