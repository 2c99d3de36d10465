"""Values that have several names, of Python or by reference: what changes one of them changes it for all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import QosValue, Value
from roslens.source.extract.ir.program import Member, Name
from roslens.source.extract.symbols.declared_field import declared_field

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def changed_for_all(ctx: Context, holder: Name | Member, before: Value, after: QosValue) -> None:
    """Let a quality of service be what it was changed to under its other names too."""
    shared = ctx.dialect.names_share_objects
    match before:
        case QosValue() if before is not after and (shared or _is_reference(ctx, holder)):
            ctx.summaries.forget_all()
            ctx.state.store.refine(before, after)
            if shared:
                _in_constants(ctx, before, after)
                changed_by_call(ctx)


def newest(ctx: Context, value: Value) -> Value:
    """Return what an object became of which another name is known too: a name of Python, or a reference."""
    refined = ctx.state.store.refined
    while id(value) in refined:
        value = refined[id(value)][1]
    return value


def changed_by_call(ctx: Context) -> None:
    """In Python names are given to an object: under each of them it is changed, by whoever changes it."""
    if not ctx.dialect.names_share_objects:
        return
    for held in (ctx.state.frame.names, ctx.state.frame.members or {}):
        for name, value in held.items():
            after = newest(ctx, value)
            if after is not value:
                ctx.state.store.put(held, name, after)


def _in_constants(ctx: Context, before: QosValue, after: QosValue) -> None:
    """What a module or class holds is changed for all that use it; under a condition it may be."""
    for place, value in ctx.state.constants.items():
        if value is before:
            why = f"it may be changed, if {ctx.state.conditions[-1]}" if ctx.state.conditions else ""
            ctx.state.constants[place] = QosValue(after.qos, after.unknown or why) if why else after


def _is_reference(ctx: Context, holder: Name | Member) -> bool:
    """Whether what is changed is a member that refers to something outside of its object."""
    thing = ctx.state.frame.object
    if thing is None or holder.name in ctx.state.frame.names:
        return False
    return declared_field(ctx.index, thing.defined, holder.name).endswith("&")
