"""Values that are changed in place: whoever holds one holds what it became."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Callable, Named, Names, QosValue, Unknown, Value
from roslens.source.extract.domain.kinds import fields_of
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
    match holder, after:
        case Call(function=Member(of=of, name=name)), _ if name in HANDED_ON:
            return refine(ctx, of, before, after)
        case Call(), QosValue():
            put_where_it_stands(ctx, before, after)
        case ((Name() | Member() as place), QosValue()):
            ctx.assign(place, after)
            changed_for_all(ctx, place, before, after)
    return after


def havoc(thing: Value, function: Function, names: Names | None = None) -> None:
    """Forget what a function sets where it was not lowered: members of its object, and numbers that it is given.

    Args:
        thing: the object.
        function: that is called.
        names: its parameters with what they are; None where it has no body to see them.
    """
    given, members = names or {}, fields_of(thing)
    for name in function.sets:
        match given.get(name):
            case bool() | int() | float():
                given[name] = Unknown(f"{name}, which {function.name}() may set")
        match members.get(name):
            case bool() | int() | float() | QosValue() | Named():
                members[name] = Unknown(f"{name}, which {function.name}() sets")
            case Text():
                members[name] = unknown(f"{name}, which {function.name}() sets")


def havoc_unseen(ctx: Context, called: Callable, written: tuple[Expression, ...]) -> None:
    """Forget what a function without a body sets: members of its object, and the numbers that it is given."""
    function = called.function
    if not function.sets:
        return
    havoc(called.self, function)
    for parameter, expression in zip(function.parameters, written, strict=False):
        match expression:
            case Name() | Member() if parameter.name in function.sets:
                _may_set(ctx, expression, f"{parameter.name}, which {function.name}() may set")


def _may_set(ctx: Context, place: Expression, reason: str) -> None:
    match ctx.value(place):
        case bool() | int() | float():
            ctx.assign(place, Unknown(reason))


HANDED_ON = frozenset(
    {"reliable", "best_effort", "transient_local", "durability_volatile", "keep_all", "keep_last", "reliability",
     "durability", "history", "liveliness", "deadline", "lifespan", "liveliness_lease_duration",
     "avoid_ros_namespace_conventions", "reliability_best_available", "durability_best_available",
     "get_rmw_qos_profile"}
)  # fmt: skip
"""Methods of a quality of service that change it and return it."""
