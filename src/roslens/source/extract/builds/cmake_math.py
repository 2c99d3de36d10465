"""``math(EXPR)`` of CMake: whole numbers of 64 bits with the operators of C."""

from __future__ import annotations

import re
from collections.abc import Callable

from roslens.source.extract.builds.cmake_evaluation import Call, Evaluation, Handler
from roslens.source.extract.builds.cmake_value import hole

_TOKEN = re.compile(r"\s*(0[xX][0-9a-fA-F]+|\d+|<<|>>|[-+*/%|&^~()])")
_MOST_TOKENS = 300
_MOST_DEPTH = 40


def _divided(one: int, other: int) -> int:
    found = abs(one) // abs(other)
    return found if (one < 0) == (other < 0) else -found


def _shift(other: int) -> int:
    if not 0 <= other < 64:
        raise ValueError(other)
    return other


_LEVELS: tuple[dict[str, Callable[[int, int], int]], ...] = (
    {"|": lambda one, other: one | other},
    {"^": lambda one, other: one ^ other},
    {"&": lambda one, other: one & other},
    {"<<": lambda one, other: one << _shift(other), ">>": lambda one, other: one >> _shift(other)},
    {"+": lambda one, other: one + other, "-": lambda one, other: one - other},
    {"*": lambda one, other: one * other, "/": _divided, "%": lambda one, other: one - other * _divided(one, other)},
)
"""Operators from the weakest to the strongest."""


def whole_number(expression: str) -> int | None:
    """Return what an expression comes to; None where it is wrong, or more than 64 bits hold."""
    tokens: list[str] = []
    at = 0
    text = expression.rstrip()
    while at < len(text) and len(tokens) <= _MOST_TOKENS:
        match = _TOKEN.match(text, at)
        if match is None:
            return None
        tokens.append(match[1])
        at = match.end()
    if len(tokens) > _MOST_TOKENS:
        return None
    reading = _Reading(tokens)
    try:
        found = reading.level(0)
    except (IndexError, ValueError, ZeroDivisionError, RecursionError):
        return None
    return found if reading.at == len(tokens) else None


class _Reading:
    def __init__(self, tokens: list[str]) -> None:
        self._tokens = tokens
        self._depth = 0
        self.at = 0

    def level(self, number: int) -> int:
        if number == len(_LEVELS):
            return self._one()
        found = self.level(number + 1)
        while self.at < len(self._tokens) and self._tokens[self.at] in _LEVELS[number]:
            operator = _LEVELS[number][self._tokens[self.at]]
            self.at += 1
            found = operator(found, self.level(number + 1))
            if not -(2**63) <= found < 2**63:
                raise ValueError(found)
        return found

    def _one(self) -> int:
        sign = self._tokens[self.at]
        self.at += 1
        self._depth += 1
        if self._depth > _MOST_DEPTH:
            raise ValueError(sign)
        if sign == "(":
            found = self.level(0)
            if self._tokens[self.at] != ")":
                raise ValueError(sign)
            self.at += 1
        elif sign in "+-~":
            inner = self._one()
            found = {"+": inner, "-": -inner, "~": ~inner}[sign]
        else:
            found = int(sign, 16 if sign[:2] in ("0x", "0X") else 10)
            if found >= 2**63:
                raise ValueError(sign)
        self._depth -= 1
        return found


def _math(run: Evaluation, call: Call) -> None:
    if len(call.arguments) < 3:
        return
    _expr, variable, expression, *rest = call.arguments
    found = whole_number(expression)
    if found is None:
        run.variables.set(variable, hole(f"the number {expression}"))
    else:
        run.variables.set(variable, hex(found % 2**64) if rest[-1:] == ["HEXADECIMAL"] else str(found))


MATH: dict[str, Handler] = {"math": _math}
