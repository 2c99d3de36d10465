"""Values that are changed in place: whoever holds one holds what it became."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Callable, Named, Names, Obj, QosValue, Unknown, Value
from roslens.source.extract.ir.program import Call, Expression, Function, Member, Name
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.transfer.shared_values import changed_for_all
from roslens.source.extract.transfer.static_storage import put_where_it_stands

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def refine(ctx: Context, holder: Expression, before: Value, after: Value) -> Value:
    """Let what holds a quality of service hold what it was changed to; return that.

    Args:
        ctx: the evaluation.
        holder: the expression that was changed: a name, a member, or calls that hand on what they change
            (``qos.reliable().transient_local()``).
        before: what it was.
        after: what it became.
    """
    while isinstance(holder, Call) and isinstance(holder.function, Member) and holder.function.name in HANDED_ON:
        holder = holder.function.of
    if not isinstance(after, QosValue):
        return after
    if isinstance(holder, Call):
        put_where_it_stands(ctx, before, after)
    if not isinstance(holder, Name | Member):
        return after
    ctx.assign(holder, after)
    changed_for_all(ctx, holder, before, after)
    return after


def havoc(thing: Value, function: Function, names: Names | None = None) -> None:
    """Forget what a function sets where it was not lowered: members of its object, and numbers that it is given.

    Args:
        thing: the object.
        function: that is called.
        names: its parameters with what they are; None where it has no body to see them.
    """
    for name in function.sets if names else ():
        if names is not None and isinstance(names.get(name), bool | int | float):
            names[name] = Unknown(f"{name}, which {function.name}() may set")
    if not isinstance(thing, Obj):
        return
    for name in function.sets:
        value = thing.fields.get(name)
        match value:
            case bool() | int() | float() | QosValue() | Named():
                thing.fields[name] = Unknown(f"{name}, which {function.name}() sets")
            case Text():
                thing.fields[name] = unknown(f"{name}, which {function.name}() sets")


def havoc_unseen(ctx: Context, called: Callable, written: tuple[Expression, ...]) -> None:
    """Forget what a function without a body sets: members of its object, and the numbers that it is given."""
    function = called.function
    if not function.sets:
        return
    havoc(called.self, function)
    for parameter, expression in zip(function.parameters, written, strict=False):
        told = parameter.name in function.sets and isinstance(expression, Name | Member)
        if told and isinstance(ctx.value(expression), bool | int | float):
            ctx.assign(expression, Unknown(f"{parameter.name}, which {function.name}() may set"))


HANDED_ON = frozenset(
    {"reliable", "best_effort", "transient_local", "durability_volatile", "keep_all", "keep_last", "reliability",
     "durability", "history", "liveliness", "deadline", "lifespan", "liveliness_lease_duration",
     "avoid_ros_namespace_conventions", "reliability_best_available", "durability_best_available",
     "get_rmw_qos_profile"}
)  # fmt: skip
"""Methods of a quality of service that change it and return it."""
