"""Conditions of manifests: ``$ROS_VERSION == 2 and ($ROS_DISTRO == humble or $X != "a b")``.

The grammar is REP-149's: comparisons of variables (``$NAME``) and literals (bare or in quotes) by ``==``, ``!=``,
``<``, ``<=``, ``>``, ``>=``, as texts; joined by ``and`` (binds tighter) and ``or``; parentheses. A variable that
is not set is an empty text.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping

MAXIMUM_LENGTH = 2000
MAXIMUM_DEPTH = 50

DEFAULT_VARIABLES = {"ROS_VERSION": "2", "ROS_PYTHON_VERSION": "3"}
"""What is assumed where nothing is set: ROS 2 with Python 3."""

_NAMES = ("ROS_DISTRO", "ROS_PYTHON_VERSION", "ROS_VERSION")


class ConditionError(ValueError):
    """A condition that the grammar does not allow; ``offset`` is where, in characters from 0."""

    def __init__(self, found: str, expected: str, offset: int) -> None:
        """Keep what was found and what was expected there."""
        super().__init__(f'"{found}" at character {offset + 1}; expected {expected}')
        self.found = found
        self.expected = expected
        self.offset = offset


def environment_of(variables: Mapping[str, str]) -> dict[str, str]:
    """Return the variables that REP-149 names, from a process environment, with defaults for ROS 2."""
    chosen = dict(DEFAULT_VARIABLES)
    chosen.update((name, variables[name]) for name in _NAMES if variables.get(name))
    return dict(sorted(chosen.items()))


def evaluate(condition: str, environment: Mapping[str, str]) -> bool:
    """Return whether a condition holds.

    Raises:
        ConditionError: the text is no condition.
    """
    if len(condition) > MAXIMUM_LENGTH:
        raise ConditionError(condition[:20] + "…", f"at most {MAXIMUM_LENGTH} characters", 0)
    reader = _Reader(_tokens(condition), environment, len(condition))
    value = reader.either(0)
    reader.finish()
    return value


_TOKEN = re.compile(
    r"""\s*(?:(?P<operator>==|!=|<=|>=|<|>)|(?P<parenthesis>[()])|(?P<variable>\$[A-Za-z0-9_]+)"""
    r"""|(?P<literal>[A-Za-z0-9_-]+)|"(?P<double>[^"\n]*)"|'(?P<single>[^'\n]*)'|(?P<other>\S))"""
)

_COMPARE: dict[str, Callable[[str, str], bool]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}

_Token = tuple[str, str, int]
_END = "end"


def _tokens(text: str) -> list[_Token]:
    found: list[_Token] = []
    at = 0
    while match := _TOKEN.match(text, at):
        kind = match.lastgroup or "other"
        value = match.group(kind)
        start = match.start(kind)
        if kind == "other":
            raise ConditionError(value, "a comparison like $ROS_VERSION == 2", start)
        found.append(("quoted" if kind in ("double", "single") else kind, value, start))
        at = match.end()
    return found


class _Reader:
    """Reads the tokens from left to right and evaluates on the way."""

    def __init__(self, tokens: list[_Token], environment: Mapping[str, str], length: int) -> None:
        self._tokens = tokens
        self._environment = environment
        self._at = 0
        self._length = length

    def either(self, depth: int) -> bool:
        value = self.both(depth)
        while self._word("or"):
            right = self.both(depth)
            value = value or right
        return value

    def both(self, depth: int) -> bool:
        value = self.comparison(depth)
        while self._word("and"):
            right = self.comparison(depth)
            value = value and right
        return value

    def comparison(self, depth: int) -> bool:
        kind, text, offset = self._peek()
        if kind == "parenthesis" and text == "(":
            if depth >= MAXIMUM_DEPTH:
                raise ConditionError(text, f"at most {MAXIMUM_DEPTH} nested parentheses", offset)
            self._at += 1
            value = self.either(depth + 1)
            self._expect_closing()
            return value
        left = self._operand()
        kind, text, offset = self._peek()
        if kind != "operator":
            raise ConditionError(text, "one of == != < <= > >=", offset)
        self._at += 1
        return _COMPARE[text](left, self._operand())

    def finish(self) -> None:
        kind, text, offset = self._peek()
        if kind != _END:
            raise ConditionError(text, '"and", "or" or the end', offset)

    def _operand(self) -> str:
        kind, text, offset = self._peek()
        self._at += 1
        if kind == "variable":
            return self._environment.get(text[1:], "")
        if kind in ("literal", "quoted"):
            return text
        raise ConditionError(text, "a variable like $ROS_VERSION or a literal", offset)

    def _expect_closing(self) -> None:
        kind, text, offset = self._peek()
        if kind != "parenthesis" or text != ")":
            raise ConditionError(text, '")"', offset)
        self._at += 1

    def _word(self, word: str) -> bool:
        kind, text, _ = self._peek()
        if kind == "literal" and text == word:
            self._at += 1
            return True
        return False

    def _peek(self) -> _Token:
        return self._tokens[self._at] if self._at < len(self._tokens) else (_END, "end of condition", self._length)
