"""Arguments of Python that are spread out: ``f(*names, **options)``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Names, Unknown, Value
from roslens.source.extract.domain.guarded import is_counted
from roslens.source.extract.domain.kinds import known_text
from roslens.source.extract.ir.program import Call, Opaque

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_MOST_LEFT = 8
"""How many arguments represent those of an unknown list."""


def spread(ctx: Context, call: Call) -> tuple[list[Value], Names]:
    """Return the arguments of a call by position and by name, as far as what is spread out is known.

    Where a table is not known, ``**`` stands among the names: any of them may be given.
    """
    lists = [ctx.value(one) for name, one in call.keywords if name == "*"]
    arguments: list[Value] = []
    for one in call.arguments:
        match one:
            case Opaque(text=text) if text.startswith("*"):
                items = lists.pop(0) if lists else None
            case _:
                arguments.append(ctx.value(one))
                continue
        match items:
            case list() if is_counted(items):
                arguments += items
            case _:
                arguments += [Unknown(text)] * _MOST_LEFT
                break
    keywords: Names = {}
    for name, expression in call.keywords:
        if name == "*":
            continue
        value = ctx.value(expression)
        match value:
            case dict() if name == "**" and all(map(known_text, value)):
                keywords.update({known: item for key, item in value.items() if (known := known_text(key))})
            case _:
                keywords[name] = value
    return arguments, keywords
