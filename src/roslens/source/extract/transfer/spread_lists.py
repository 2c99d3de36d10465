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
        match one:
            case Operation(operator="*", operands=(several,)):
                items = ctx.items(ctx.value(several))
                found += [Unknown(f"each of {ctx.index.memo.text(several)}")] if items is None else items
            case _:
                found.append(ctx.value(one))
    return found
