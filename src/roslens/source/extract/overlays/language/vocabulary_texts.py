"""What functions of C++ do with texts in place: ``sprintf(name, "camera%d", 1)``, ``boost::to_lower(name)``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Value, as_text
from roslens.source.extract.domain.kinds import known_text, text_of
from roslens.source.extract.domain.plain_methods import formatted
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.ir.program import Call, Expression, Item, Member, Name, Operation
from roslens.source.extract.symbolic.text import Text, said, unknown

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def _names(*names: str) -> tuple[str, ...]:
    return tuple(f"{space}{name}" for space in ("boost.", "boost.algorithm.") for name in names)


_CHANGES: dict[str, Callable[..., str]] = {
    "replace_all": lambda of, before, after: of.replace(before, after),
    "replace_first": lambda of, before, after: of.replace(before, after, 1),
    "erase_all": lambda of, before: of.replace(before, ""),
    "erase_first": lambda of, before: of.replace(before, "", 1),
    "to_lower": lambda of: of.lower(),
    "to_upper": lambda of: of.upper(),
    "trim": lambda of: of.strip(),
    "trim_left": lambda of: of.lstrip(),
    "trim_right": lambda of: of.rstrip(),
}
_COPIES = {f"{name}_copy": change for name, change in _CHANGES.items()}
_OTHERS = ("replace_last", "erase_last", "replace_nth", "erase_nth", "trim_if", "trim_left_if", "trim_right_if",
           "replace_regex", "erase_regex", "replace_all_regex", "erase_all_regex", "erase_head", "erase_tail",
           "replace_head", "replace_tail", "find_format", "find_format_all")  # fmt: skip


@outer(*_names(*_CHANGES, *_OTHERS))
def changed(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A text is changed where it is."""
    if called.given(Text, 0) is not None and called.written:
        _put(ctx, called.written[0], _result(called, _CHANGES.get(_last(called.name))))
    return None


@outer(*_names(*_COPIES), quiet=True)
def copied(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A changed copy of a text is made."""
    return _result(called, _COPIES[_last(called.name)])


def _last(name: str) -> str:
    return name.rpartition(".")[2]


def _result(called: CallSite, change: Callable[..., str] | None) -> Text:
    texts = [known_text(one) for one in called.arguments]
    of = as_text(called.argument(0))
    if change is not None and texts and None not in texts:
        try:
            return Text.of(change(*texts))
        except TypeError:
            pass
    parameter = next((hole.parameter for hole in of.holes), "")
    return unknown(said(of, f", which {called.name}() changed", most=200), parameter=parameter)


@outer("std.transform", "std.reverse", "std.sort", "std.remove", "std.remove_if", "std.unique", "std.fill",
       "std.replace_if", "std.rotate", "std.random_shuffle", "std.shuffle")  # fmt: skip
def rearranged(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """What lies between two iterators is changed: ``std::transform(s.begin(), s.end(), s.begin(), ::tolower)``."""
    place = 2 if called.name == "std.transform" else 0
    match called.written[place : place + 1]:
        case (Call(function=Member(of=Name() | Member() as target, name="begin" | "rbegin")),):
            value = text_of(ctx.value(target))
        case _:
            return None
    if value is None:
        return None
    match called.written[0]:
        case Call(function=Member(of=source)):
            same = source == target
        case _:
            same = False
    change = _sign_by_sign(called.written[-1]) if called.name == "std.transform" and same else None
    parameter = next((hole.parameter for hole in value.holes), "")
    doubtful = unknown(said(value, f", which {called.name}() changed", most=200), parameter=parameter)
    ctx.assign(target, doubtful if change is None or value.known is None else Text.of(change(value.known)))
    return None


def _sign_by_sign(written: Expression) -> Callable[[str], str] | None:
    match written:
        case Name(name=name) | Member(name=name):
            return {"tolower": str.lower, "toupper": str.upper}.get(name.rpartition(".")[2])
    return None


@outer("sprintf", "std.sprintf", "snprintf", "std.snprintf", "vsprintf", "vsnprintf", quiet=True)
def printed(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A text is written into a buffer: ``snprintf(name, sizeof(name), "camera%d", number)``."""
    first = 2 if "snprintf" in called.name else 1
    pattern = called.given(Text, first)
    if called.written:
        found = unknown(f"the output of {called.name}()")
        if pattern is not None and not called.name.startswith("v"):
            found = formatted(pattern, called.arguments[first + 1 :])
        _put(ctx, called.written[0], found)
    return None


@outer("strcpy", "std.strcpy", "strncpy", "std.strncpy", "strcat", "std.strcat", "strncat", "std.strncat")
def copied_into(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A text is copied into a buffer, or behind what is in it."""
    if len(called.written) > 1:
        adds, some = "cat" in called.name, "strn" in called.name
        pieces = [as_text(one) for one in called.arguments[: 2 if adds else 0]] or [as_text(called.argument(1))]
        _put(ctx, called.written[0], unknown(f"the output of {called.name}()") if some else Text.of(*pieces))
    return None


def _put(ctx: Context, written: Expression, value: Text) -> None:
    match written:
        case Operation(operator="&", operands=(Item(of=of), *_)) | Item(of=of):
            _put_whole(ctx, of, unknown("a string that is partly overwritten"))
        case Operation(operator="&", operands=(of, *_)):
            _put_whole(ctx, of, value)
        case _:
            _put_whole(ctx, written, value)


def _put_whole(ctx: Context, written: Expression, value: Text) -> None:
    match written:
        case Name() | Member():
            ctx.assign(written, value)
