"""Variables of the function around a lambda of C++: those it has copies of, and those it sees and sets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Callable, Names, QosValue, Unknown, Value
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.ir.program import Lambda, Name
from roslens.source.extract.symbolic.text import Text, unknown

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


class Around(dict[str, Value]):
    """Variables of which a lambda has copies.

    Attributes:
        frame: of the function around, whose other variables it sees as they are when it is called.
    """

    __slots__ = ("frame",)

    def __init__(self, frame: Frame, copies: Names) -> None:
        """Hold copies of variables of a function."""
        super().__init__(copies)
        self.frame = frame

    def __bool__(self) -> bool:
        """Whether there is anything around: variables that it sees, even if it has copies of none."""
        return True


def names_around(ctx: Context, made: Lambda) -> Names:
    """Return the variables around a lambda that is made now."""
    frame, holds = ctx.state.frame, made.holds
    if not holds:
        return Around(frame, {}) if frame.aliases else frame.names
    if holds[0] != "=":
        known = (*frame.names, *frame.aliases)
        return Around(frame, {name: ctx.value(Name(name)) for name in holds if name in known})
    copies = {**frame.names, **_referred(ctx)}
    for name in holds[1:]:
        copies.pop(name, None)
    return Around(frame, copies)


def names_now(ctx: Context, around: Around) -> Names:
    """Return what the variables around a lambda are that is called now."""
    frame = around.frame
    if not frame.aliases:
        return {**frame.names, **around}
    outer, ctx.state.frame = ctx.state.frame, frame
    try:
        return {**frame.names, **_referred(ctx), **around}
    finally:
        ctx.state.frame = outer


def _referred(ctx: Context) -> Names:
    return {name: ctx.value(one) for name, (one, _) in ctx.state.frame.aliases.items()}


def set_around(ctx: Context, function: Callable, frame: Frame) -> None:
    """Forget what variables around a lambda were that it set when it was called.

    Whether a name is that of a variable around, or of one of its own (``auto topic = "b"``), a program does not tell:
    so nobody knows what the one around is, rather than that it has a value that it may not have.
    """
    around, what = function.names, function.function
    if around is None or not ctx.index.programs[function.path].dialect.copies_are_captured:
        return
    own = {parameter.name for parameter in what.parameters}
    holds: Names = {}
    names = around
    match around:
        case Around():
            holds, names = around, around.frame.names
    for name, after in frame.names.items():
        before = names.get(name)
        if before is None or after is before or name in own or name in holds or after == before:
            continue
        lost = _lost(name, before)
        if lost is not None:
            names[name] = lost
    match around:
        case Around() if around.frame.aliases:
            _set_referred(ctx, around, frame, own)


def _set_referred(ctx: Context, around: Around, frame: Frame, own: set[str]) -> None:
    """Forget what other names of variables around lead to where a lambda set it."""
    outer, ctx.state.frame = ctx.state.frame, around.frame
    try:
        for name, before in _referred(ctx).items():
            lost = None if name in own or name in around else _lost(name, before)
            if lost is not None and frame.names.get(name, before) != before:
                ctx.assign(Name(name), lost)
    finally:
        ctx.state.frame = outer


def _lost(name: str, before: Value) -> Text | Unknown | None:
    match before:
        case Text():
            return unknown(f"{name}, which a lambda sets")
        case Unknown() | bool() | int() | float() | QosValue():
            return Unknown(f"{name}, which a lambda sets")
    return None
