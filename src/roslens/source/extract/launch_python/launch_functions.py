"""What functions of Python come to that are given functions and lists: ``map``, ``partial``, ``reduce``, ``chain``.

Items of a list that are there under a condition keep it, and what is not known stays in its place among the others.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable as Function1
from typing import TypeAlias

import msgspec

from roslens.source.extract.domain.abstract_value import Foreign, Named, Names, Obj, Unknown, Value
from roslens.source.extract.domain.guarded import Guarded, guarded, in_place_of, is_counted, unguarded
from roslens.source.extract.domain.kinds import name_of
from roslens.source.extract.domain.table_key import hashable
from roslens.source.extract.domain.unknown_lists import each_of
from roslens.source.extract.launch_python.launch_values import Made, Plain, plain
from roslens.source.extract.symbolic.text import Text, Written
from roslens.source.extract.transfer.context import Context

_MOST_ITEMS = 1_000


class Partial(Foreign, frozen=True, eq=False):
    """A function of which some arguments are given: ``functools.partial(Node, package="p")``."""

    function: Value
    arguments: list[Value]
    keywords: dict[str, Value]


class Bound(Foreign, frozen=True, eq=False):
    """A method of a value that is no object of a class of the workspace: ``description.add_action``."""

    of: Value
    name: str


class Shape(Foreign, frozen=True, eq=False):
    """A class that ``collections.namedtuple`` makes."""

    name: str
    fields: tuple[str, ...]
    defaults: list[Value] = msgspec.field(default_factory=list)

    def make(self, arguments: list[Value], keywords: Names) -> Value:
        """Return an object of it."""
        first = len(self.fields) - len(self.defaults)
        values: dict[str, Value] = dict(zip(self.fields[first:], self.defaults, strict=True))
        values |= dict(zip(self.fields, arguments, strict=False))
        return Obj(self.name, None, values | keywords)


class Calling(msgspec.Struct, frozen=True, eq=False):
    """A call of a function that is given others.

    Attributes:
        ctx: the evaluation.
        written: the call, as the file has it.
        apply: calls a value.
        arguments: values by position.
        keywords: values by name.
    """

    ctx: Context
    written: str
    apply: Function1[[Value, list[Value], Names], Value]
    arguments: list[Value]
    keywords: Names

    def items(self, value: Value) -> list[Value] | None:
        """Return the items of a list; None where they are unknown."""
        match value:
            case Text(known=str(known)):
                return [Text.of(sign) for sign in known]
        return self.ctx.items(value)

    def spread(self, value: Value) -> list[Value]:
        """Return the items of a list; one value stands for those that are unknown."""
        known = self.items(value)
        return [Unknown(f"each of {self.written}")] if known is None else known


_Word: TypeAlias = Function1[[Calling], Value]


def call_with_functions(name: str, calling: Calling) -> Value:
    """Return what a call of one of :data:`FUNCTIONS` comes to; unknown where its arguments are of other kinds."""
    try:
        return FUNCTIONS[name](calling)
    except (TypeError, ValueError, IndexError):
        return Unknown(f"result of {name}()")


def _partial(calling: Calling) -> Value:
    function, *given = calling.arguments
    return Partial(function, given, dict(calling.keywords))


def _map(calling: Calling) -> Value:
    function, *lists = calling.arguments
    known = [calling.items(one) for one in lists]
    rows = [one for one in known if one is not None]
    if len(rows) < len(lists):
        return _for_all(calling, function, [each_of(one) for one in lists])
    if len(rows) == 1:
        return [_mapped(calling, function, one) for one in rows[0]]
    return [calling.apply(function, list(one), {}) for one in zip(*rows, strict=False)]


def _mapped(calling: Calling, function: Value, item: Value) -> Value:
    match item:
        case Guarded():
            pass
        case _:
            return calling.apply(function, [item], {})
    here = len(calling.ctx.state.conditions)
    calling.ctx.state.under(item.condition, item.test)
    found = calling.apply(function, [item.value], {})
    del calling.ctx.state.conditions[here:]
    return in_place_of(item, found)


def _for_all(calling: Calling, function: Value, items: list[Value]) -> Value:
    """Return a list with what a function makes of each item of lists that are unknown."""
    here = len(calling.ctx.state.conditions)
    condition = Written(f"there is any of {calling.written}")
    calling.ctx.state.under(condition)
    found = calling.apply(function, items, {})
    del calling.ctx.state.conditions[here:]
    return [Guarded(found, condition)]


def _filter(calling: Calling) -> Value:
    function, over = calling.arguments
    found: list[Value] = []
    for one in calling.spread(over):
        value = unguarded(one)
        holds = calling.ctx.truth(value if function is None else calling.apply(function, [value], {}))
        if holds is None:
            found += guarded([one], Written(f"{calling.written} has {_named(value)}"), None)
        elif holds:
            found.append(one)
    return found


def _named(value: Value) -> str:
    match value:
        case Text():
            return str(value)
        case Made():
            return f"the {value.name} of line {value.evidence.line}"
    return "it"


def _chain(calling: Calling) -> Value:
    return [item for one in calling.arguments for item in calling.spread(one)]


def _chain_of(calling: Calling) -> Value:
    found: list[Value] = []
    for one in calling.spread(calling.arguments[0]):
        inner = calling.spread(unguarded(one))
        match one:
            case Guarded():
                found += guarded(inner, one.condition, one.test)
            case _:
                found += inner
    return found


def _sum(calling: Calling) -> Value:
    items = calling.spread(calling.arguments[0])
    start = calling.keywords.get("start", calling.arguments[1] if len(calling.arguments) > 1 else 0)
    match start:
        case list():
            return _chain_of(Calling(calling.ctx, calling.written, calling.apply, [[start, *items]], {}))
    whole: Value = start
    for one in items:
        whole = calling.ctx.expressions.sum(whole, one)
    return whole


def _reduce(calling: Calling) -> Value:
    function, over, *first = calling.arguments
    items = calling.spread(over)
    if not is_counted(items):
        raise ValueError
    whole, *rest = [*first, *items]
    for one in rest:
        whole = calling.apply(function, [whole, one], {})
    return whole


def _next(calling: Calling) -> Value:
    over, *default = calling.arguments
    items = calling.items(over)
    match items:
        case []:
            return default[0] if default else Unknown(f"result of {calling.written}")
        case None | [Guarded(), *_]:
            return Unknown(f"result of {calling.written}")
    match over:
        case list():
            calling.ctx.state.store.items(over)
            return over.pop(0)
    return items[0]


def _iter(calling: Calling) -> Value:
    return list(calling.spread(calling.arguments[0]))


def _sorted(calling: Calling) -> Value:
    items = calling.items(calling.arguments[0])
    if items is None or not is_counted(items):
        raise ValueError
    key, reverse = calling.keywords.get("key"), calling.keywords.get("reverse", False)
    keys = [plain(one if key is None else calling.apply(key, [one], {})) for one in items]
    if type(reverse) is not bool or not all(map(_is_comparable, keys)):
        raise ValueError
    order = sorted(range(len(items)), key=keys.__getitem__, reverse=reverse)
    return [items[place] for place in order]


def _extreme(calling: Calling, last: int) -> Value:
    over = calling.arguments[0] if len(calling.arguments) == 1 else list(calling.arguments)
    keywords = {"key": calling.keywords["key"]} if "key" in calling.keywords else {}
    match _sorted(Calling(calling.ctx, calling.written, calling.apply, [over], keywords)):
        case [_, *_] as found:
            return found[last]
    return calling.keywords.get("default")


def _is_comparable(value: Plain) -> bool:
    match value:
        case list():
            return all(map(_is_comparable, value))
        case str() | int() | float():
            return True
    return False


def _product(calling: Calling) -> Value:
    lists = [calling.spread(one) for one in calling.arguments]
    repeat = _number(calling.keywords.get("repeat", 1))
    if not all(map(is_counted, lists)):
        raise ValueError
    return [list(one) for one in itertools.islice(itertools.product(*lists, repeat=repeat), _MOST_ITEMS)]


def _repeat(calling: Calling) -> Value:
    value, times = calling.arguments
    return [value] * min(_number(times), _MOST_ITEMS)


def _slice(calling: Calling) -> Value:
    over, *bounds = calling.arguments
    items = calling.items(over)
    if items is None or not is_counted(items):
        raise ValueError
    return list(itertools.islice(items, *(None if one is None else _number(one) for one in bounds)))


def _number(value: Value) -> int:
    match value:
        case int():
            return value
    raise TypeError


def _added(calling: Calling) -> Value:
    one, other = calling.arguments
    return calling.ctx.expressions.sum(one, other)


def _or(calling: Calling) -> Value:
    match calling.arguments:
        case [dict() as one, dict() as other]:
            return {**one, **other}
    raise ValueError


def _shape(calling: Calling) -> Value:
    name, fields = (plain(one) for one in calling.arguments[:2])
    match fields, calling.keywords.get("defaults", []):
        case str(), list() as defaults:
            names = fields.replace(",", " ").split()
        case list(), list() as defaults:
            names = [str(one) for one in fields]
        case _:
            raise TypeError
    if len(defaults) > len(names):
        raise ValueError
    return Shape(str(name), tuple(names), defaults)


def _all(calling: Calling) -> Value:
    return _truths(calling, stops=False)


def _any(calling: Calling) -> Value:
    return _truths(calling, stops=True)


def _truths(calling: Calling, *, stops: bool) -> Value:
    items = calling.items(calling.arguments[0])
    if items is None:
        raise ValueError
    holds = [None if type(one) is Guarded else calling.ctx.truth(one) for one in items]
    if stops in holds:
        return stops
    return Unknown(calling.written) if None in holds else not stops


def _is_of_kind(calling: Calling) -> Value:
    """Return whether a value is of a kind that Python has; substitutions and what is not known are of any."""
    value, kinds = calling.arguments
    match kinds:
        case Named(name=name):
            names = {name}
        case list():
            names = {name_of(one) for one in kinds}
        case _:
            raise TypeError
    found = next((kind for kind, classes in _KINDS if type(value) in classes), None)
    if found is None or not names <= _NAMES_OF_KINDS:
        raise TypeError
    return not names.isdisjoint(found)


def _with_keys(calling: Calling) -> Value:
    keys, *value = calling.arguments
    return {hashable(one): value[0] if value else None for one in calling.spread(keys)}


_KINDS: tuple[tuple[frozenset[str], tuple[type, ...]], ...] = (
    (frozenset({"str"}), (Text,)),
    (frozenset({"bool", "int"}), (bool,)),
    (frozenset({"int"}), (int,)),
    (frozenset({"float"}), (float,)),
    # Tuples are lists here.
    (frozenset({"list", "tuple"}), (list,)),
    (frozenset({"dict"}), (dict,)),
)
_NAMES_OF_KINDS = frozenset({"str", "bool", "int", "float", "list", "tuple", "dict", "pathlib.Path", "Path"})
FUNCTIONS: dict[str, _Word] = {
    "functools.partial": _partial,
    "map": _map,
    "filter": _filter,
    "itertools.chain": _chain,
    "itertools.chain.from_iterable": _chain_of,
    "sum": _sum,
    "functools.reduce": _reduce,
    "next": _next,
    "iter": _iter,
    "sorted": _sorted,
    "min": lambda calling: _extreme(calling, 0),
    "max": lambda calling: _extreme(calling, -1),
    "any": _any,
    "all": _all,
    "itertools.product": _product,
    "itertools.repeat": _repeat,
    "itertools.islice": _slice,
    "operator.add": _added,
    "operator.concat": _added,
    "operator.iadd": _added,
    "operator.or_": _or,
    "collections.namedtuple": _shape,
    "dict.fromkeys": _with_keys,
    "isinstance": _is_of_kind,
}
"""By whole names."""
