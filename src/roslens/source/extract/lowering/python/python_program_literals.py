"""Literals of Python as values of a small program, and text that is put together in place.

A conversion that is more than putting the value in is a call of the built-in function that does it: ``{x!r}`` and
``%r`` are ``repr(x)``, ``{x:02d}`` and ``%02d`` are ``format(x, '02d')``, ``%d`` is ``int(x)``. These
calls have no line.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence as Several
from math import isfinite
from string import Formatter

from roslens.source.extract.ir.program import Call, Expression, Format, Item, Literal, Mapping, Member, Name

LONGEST_TEXT = 2000
"""Characters of a literal that are kept; a longer one names nothing."""

_ESCAPE = re.compile(
    r"\\(?:(\r?\n)|([\\'\"abfnrtv])|([0-7]{1,3})|x([0-9a-fA-F]{2})|u([0-9a-fA-F]{4})|U([0-9a-fA-F]{8})|N\{([^}]*)\})"
)
_SINGLE = {"\\": "\\", "'": "'", '"': '"', "a": "\a", "b": "\b", "f": "\f", "n": "\n", "r": "\r", "t": "\t", "v": "\v"}
_LARGEST_SIGN = 0x10FFFF
_OLD_OCTAL = re.compile(r"0[0-7]+")
_SMALLEST, _LARGEST = -(2**63), 2**63
_PERCENT = re.compile(r"%(?:\(([^)]*)\))?([#0\- +]*)(\*|\d+)?(?:\.(\*|\d*))?[hlL]?([diouxXeEfFgGcrsa%])")
_FIELD = re.compile(r"(\w*)((?:\.\w+|\[[^\]]+\])*)")
_STEP = re.compile(r"\.(\w+)|\[([^\]]+)\]")
_KEPT_AS_WRITTEN = frozenset("xXoeEfFgGd")


def number(text: str) -> int | float | None:
    """Return the value of a number as written, Python 2's octals and ``L`` included; None where it is kept by none."""
    text = text.rstrip("lL")
    try:
        value = int(text, 8) if _OLD_OCTAL.fullmatch(text) else int(text, 0)
    except ValueError:
        try:
            fraction = float(text)
        except ValueError:
            return None
        return fraction if isfinite(fraction) else None
    return value if _SMALLEST <= value < _LARGEST else None


def unescape(text: str) -> str:
    """Return what ``text`` between quotes stands for; escapes that Python does not know stay."""
    return _ESCAPE.sub(_meant, text).encode("utf-8", "backslashreplace").decode()


def _meant(match: re.Match[str]) -> str:
    if match[1]:
        return ""
    if match[2]:
        return _SINGLE[match[2]]
    if match[7] is not None:
        try:
            return unicodedata.lookup(match[7])
        except KeyError:
            return match[0]
    code = int(match[3], 8) if match[3] else int(match[4] or match[5] or match[6], 16)
    return chr(code) if code <= _LARGEST_SIGN else match[0]


def joined(parts: Several[Expression]) -> Expression:
    """Return ``parts`` as one text; a :class:`Literal` where all of it is known."""
    merged: list[Expression] = []
    for part in parts:
        match merged[-1:], part:
            case _, Literal(value=""):
                pass
            case [Literal(value=str(before))], Literal(value=str(text)):
                merged[-1] = Literal(before + text)
            case _:
                merged.append(part)
    match merged:
        case []:
            return Literal("")
        case [Literal(value=str()) as whole]:
            return whole
    return Format(tuple(merged))


def converted(value: Expression, conversion: str, layout: str) -> Expression:
    """Return ``value`` as ``{value!conversion:layout}`` puts it into a text."""
    if conversion in {"r", "a"}:
        value = Call(Name("repr" if conversion == "r" else "ascii"), (value,))
    return Call(Name("format"), (value, Literal(layout))) if layout else value


def braces(template: str, arguments: Several[Expression], keywords: dict[str, Expression]) -> Expression | None:
    """Return what ``template.format(...)`` is; None where it cannot be determined."""
    parts: list[Expression] = []
    counted = 0
    try:
        for literal, field, layout, conversion in Formatter().parse(template):
            parts.append(Literal(literal))
            if field is None:
                continue
            match = _FIELD.fullmatch(field)
            if match is None or "{" in (layout or ""):
                return None
            value = _of_field(match, counted, arguments, keywords)
            if not match[1]:
                counted += 1
            parts.append(converted(value, conversion or "", layout or ""))
    except (ValueError, IndexError, KeyError):
        return None
    return joined(parts)


def _of_field(
    field: re.Match[str], counted: int, arguments: Several[Expression], keywords: dict[str, Expression]
) -> Expression:
    """Return what ``{key.member[item]}`` stands for; without a key that is the argument at ``counted``.

    Raises:
        IndexError: no argument is there.
        KeyError: no keyword has that name.
    """
    key = field[1] or str(counted)
    value = arguments[int(key)] if key.isdecimal() else keywords[key]
    for step in _STEP.finditer(field[2]):
        value = _stepped(value, step)
    return value


def _stepped(value: Expression, step: re.Match[str]) -> Expression:
    if step[1]:
        return Member(value, step[1])
    return Item(value, Literal(int(step[2]) if step[2].isdecimal() else step[2]))


def percent(template: str, right: Expression, items: tuple[Expression, ...] | None) -> Expression | None:
    """Return what ``template % right`` is; None where it cannot be determined.

    Args:
        template: the text on the left.
        right: what stands on the right.
        items: of ``right`` where it is a tuple.
    """
    marks = list(_PERCENT.finditer(template))
    places = [mark for mark in marks if mark[5] != "%"]
    if "%" in _PERCENT.sub("", template) or any(mark[3] == "*" or mark[4] == "*" for mark in places):
        return None
    named = any(mark[1] is not None for mark in places)
    values = iter((right,) if items is None else items)
    if not named and len(places) != (1 if items is None else len(items)):
        return None
    parts: list[Expression] = []
    end = 0
    for mark in marks:
        parts.append(Literal(template[end : mark.start()]))
        end = mark.end()
        if mark[5] == "%":
            parts.append(Literal("%"))
            continue
        if named and mark[1] is None:
            return None
        parts.append(_put(mark, _looked_up(right, mark[1]) if named else next(values)))
    return joined([*parts, Literal(template[end:])])


def _looked_up(mapping: Expression, key: str) -> Expression:
    match mapping:
        case Mapping(items=items):
            for name, value in items:
                if name == Literal(key):
                    return value
    return Item(mapping, Literal(key))


def _put(mark: re.Match[str], value: Expression) -> Expression:
    _, flags, width, precision, kind = mark.groups()
    plain = not (flags or width or precision is not None)
    if kind in "iu":
        kind = "d"
    if plain and kind == "d":
        return _whole(value)
    if kind in "ras":
        value = converted(value, kind, "")
        kind = ""
    elif kind not in _KEPT_AS_WRITTEN:
        return Call(Name("format"), (value, Literal(mark[0])))
    return value if plain and not kind else _laid_out(value, flags, width, precision, kind)


def _whole(value: Expression) -> Expression:
    match value:
        case Literal(value=int() as number) if not isinstance(number, bool):
            return value
    return Call(Name("int"), (value,))


def _laid_out(value: Expression, flags: str, width: str | None, precision: str | None, kind: str) -> Expression:
    """Return a value that is written in a layout of ``%``, as ``format`` has it."""
    align = "<" if "-" in flags else "" if kind else ">"
    sign = "+" if "+" in flags else " " if " " in flags else ""
    zero = "0" if "0" in flags and not align else ""
    digits = f".{precision or 0}" if precision is not None else ""
    return Call(
        Name("format"), (value, Literal(f"{align}{sign}{'#' * ('#' in flags)}{zero}{width or ''}{digits}{kind}"))
    )
