"""Constructors that Python makes of the fields of a class: of dataclasses, named tuples and the like."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Names, Obj, Unknown, Value

if TYPE_CHECKING:
    from roslens.source.extract.symbols.symbol_table import Defined
    from roslens.source.extract.transfer.context import Context

_WITHOUT = frozenset({"object", "NamedTuple", "Protocol", "ABC", "Generic"})
"""Bases that have no constructor of their own."""


def set_fields(ctx: Context, thing: Obj, defined: Defined, arguments: list[Value], keywords: Names) -> bool:
    """Set the fields of an object whose class has no constructor; return whether it takes them.

    A class that takes arguments, has no constructor and no base elsewhere that may have one, takes its annotated
    fields, those of its bases first.
    """
    chain = ctx.index.chain(defined)
    if any(one.rpartition(".")[2] not in _WITHOUT for one in ctx.index.outer_bases(defined)):
        return False
    if any(ctx.index.methods(one, "__init__") for one in chain):
        return False
    names = [field.name for one in reversed(chain) for field in one.what.fields if _is_given(field.type)]
    names = list(dict.fromkeys(names))
    if not names:
        return False
    thing.fields.update(zip(names, arguments, strict=False))
    thing.fields.update({name: value for name, value in keywords.items() if name in names})
    if "**" in keywords:
        rest = (name for name in names[len(arguments) :] if name not in keywords)
        thing.fields.update({name: Unknown(f"{name}, which may be given") for name in rest})
    return True


def _is_given(declared: str) -> bool:
    return bool(declared) and "ClassVar" not in declared
