"""Lists of Python with others in them: ``[*first, last]``, where a program keeps what stands behind the star."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Unknown, Value
from roslens.source.extract.ir.program import Operation, Sequence

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def spread_out(ctx: Context, expression: Sequence) -> list[Value]:
    """Return a list with the items of those that are spread out in it; one value stands for those that are unknown."""
    found: list[Value] = []
    for one in expression.items:
        if not isinstance(one, Operation) or one.operator != "*" or len(one.operands) != 1:
            found.append(ctx.value(one))
            continue
        items = ctx.items(ctx.value(one.operands[0]))
        found += [Unknown(f"each of {ctx.index.memo.text(one.operands[0])}")] if items is None else items
    return found
