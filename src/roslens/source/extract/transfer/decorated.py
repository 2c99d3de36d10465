"""Functions of Python that a function of the workspace decorates: what is called is what that returns."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.abstract_value import Callable, Invocation, Unknown, Value
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.ir.program import Call, Expression, Name

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def decorated(ctx: Context, function: Callable) -> Callable | Unknown:
    """Return what a call of a function calls; the function itself where nothing of the workspace decorates it.

    Decorators from elsewhere are taken for such as hand on what they decorate. Of a method only its result is lost: its
    object is bound before.
    """
    what = function.function
    outer, ctx.state.frame = ctx.state.frame, Frame(function.path, what.qualified_name.rpartition(".")[0])
    try:
        known = [one for one in what.decorators if _is_known(ctx, one)]
        if not known:
            return function
        bare = ctx.named.bare.setdefault(id(what), (what, msgspec.structs.replace(what, decorators=())))[1]
        itself = Callable(bare, function.path, function.self, function.names, function.arguments)
        if what.class_name:
            ctx.call(Invocation(itself, [Unknown(f"parameter {one.name} of {what.name}()") for one in what.parameters]))
            return Unknown(f"result of {what.name}(), which is decorated")
        made: Value = itself
        for one in reversed(known):
            match ctx.value(one):
                case Callable() as decorator:
                    made = ctx.call(Invocation(decorator, [made]))
                case _:
                    made = None
        match made:
            case Callable():
                return made
        return Unknown(f"result of {what.name}(), which is decorated")
    finally:
        ctx.state.frame = outer


def _is_known(ctx: Context, decorator: Expression) -> bool:
    match decorator:
        case Call(function=Name(name=name)) | Name(name=name):
            return ctx.named.function(name, 1) is not None
    return False
