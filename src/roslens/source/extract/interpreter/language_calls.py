"""Calls that mean the same in every program: casts, pointers to what is made, and conversions to texts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Names, Value
from roslens.source.extract.domain.made_texts import text_made
from roslens.source.extract.domain.owned_pointer import OWNERS, owns_first
from roslens.source.extract.symbols.symbol_table import type_arguments, type_name

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_POINTERS = frozenset(
    {"std.make_shared", "std.make_unique", "boost.make_shared", "make_shared", "make_unique", "new",
     "std.allocate_shared"}
)  # fmt: skip
_CASTS = frozenset(
    {"std.move", "std.forward", "std.ref", "std.cref", "boost.ref", "boost.cref", "std.dynamic_pointer_cast",
     "std.static_pointer_cast", "move", "static_cast", "dynamic_cast", "std.const_pointer_cast",
     "std.make_optional", "std.addressof"}
)  # fmt: skip
FROM_THIS = frozenset({"shared_from_this", "weak_from_this"})
BINDS = frozenset({"std.bind", "boost.bind", "bind", "functools.partial", "std.bind_front"})
_TEXTS = frozenset({"std.string", "string", "std.to_string", "str", "std.string_view", "QString", "unicode"})
KNOWN = frozenset({"super", *_POINTERS, *_CASTS, *OWNERS, *FROM_THIS, *BINDS, *_TEXTS})


def of_language(
    ctx: Context, name: str, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
) -> tuple[Value] | None:
    """Return what a cast, a pointer or a conversion makes; None where the name means none of these here."""
    if name in FROM_THIS and ctx.state.frame.object is not None:
        return (ctx.state.frame.object,)
    if name in _POINTERS and templates:
        kind, inside = type_name(templates[0])
        return (ctx.objects.of_type(kind, arguments, keywords, tuple(type_arguments(inside))),)
    if (name in _CASTS and arguments) or (name in OWNERS and owns_first(arguments)):
        return (arguments[0],)
    return (text_made(name, arguments),) if name in _TEXTS and arguments else None
