"""Conditions of ``if()``: true, false, or unknown with the answer that is usual; cmake-commands(7), *if*."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from typing import Protocol

import msgspec

from roslens.source.extract.builds.cmake_syntax import Argument
from roslens.source.extract.builds.cmake_value import (
    OPEN,
    expression_of,
    is_off,
    is_unknown,
    items_of,
    number_of,
    searchable,
    truth_of,
    versions_compared,
)

_MOST_DEPTH = 40


class Answer(msgspec.Struct, frozen=True, gc=False):
    """What a condition comes to: ``value`` None is unknown, and then ``usual`` holds where nobody decides otherwise."""

    value: bool | None
    usual: bool | None = None

    @property
    def likely(self) -> bool | None:
        """The value, or what is usual."""
        return self.usual if self.value is None else self.value


TRUE, FALSE, UNKNOWN = Answer(True), Answer(False), Answer(None)


class Word(msgspec.Struct, frozen=True, gc=False):
    """An argument of a condition with its value."""

    text: str
    quoted: bool = False
    paren: bool = False


class Surroundings(Protocol):
    """What conditions ask for."""

    def words(self, arguments: tuple[Argument, ...]) -> list[Word]:
        """Return arguments with their values."""

    def variable(self, name: str) -> tuple[str | None, bool]:
        """Return the value of a variable (None where not set) and whether the user may set it otherwise."""

    def exists(self, path: str, *, folder: bool) -> bool | None:
        """Return whether there is a file or folder."""

    def target(self, name: str) -> bool | None:
        """Return whether there is a target."""

    def command(self, name: str) -> bool | None:
        """Return whether there is a command."""

    def matched(self, groups: Sequence[str]) -> None:
        """Take what MATCHES has matched: nothing where it has not."""


def answer(arguments: tuple[Argument, ...], around: Surroundings) -> Answer:
    """Return what a condition comes to; what is not understood is unknown."""
    words = around.words(arguments)
    reading = _Reading(words, around)
    try:
        found = reading.alternatives(0)
    except (IndexError, RecursionError):
        return UNKNOWN
    return found if reading.at == len(words) else UNKNOWN


def opposite(one: Answer) -> Answer:
    """Return NOT of an answer."""
    return Answer(None if one.value is None else not one.value, None if one.usual is None else not one.usual)


def _both(one: Answer, other: Answer) -> Answer:
    if one.value is False or other.value is False:
        return FALSE
    if one.value and other.value:
        return TRUE
    if one.likely is False or other.likely is False:
        return Answer(None, False)
    return Answer(None, True if one.likely and other.likely else None)


def _either(one: Answer, other: Answer) -> Answer:
    return opposite(_both(opposite(one), opposite(other)))


_Joint = Callable[[Answer, Answer], Answer]


def _tight(operands: list[Answer], joints: list[_Joint]) -> Answer:
    groups = [operands[:1]]
    for joint, operand in zip(joints, operands[1:], strict=True):
        if joint is _both:
            groups[-1].append(operand)
        else:
            groups.append([operand])
    return reduce(_either, (reduce(_both, group) for group in groups))


def _in_turn(operands: list[Answer], joints: list[_Joint]) -> Answer:
    found = operands[0]
    for joint, operand in zip(joints, operands[1:], strict=True):
        found = joint(found, operand)
    return found


def _in_pairs(operands: list[Answer], joints: list[_Joint]) -> Answer:
    while joints:
        paired = [
            joint(one, other) for joint, one, other in zip(joints[::2], operands[::2], operands[1::2], strict=False)
        ]
        operands, joints = [*paired, *operands[2 * len(paired) :]], joints[1::2]
    return operands[0]


class _Reading:
    def __init__(self, words: list[Word], around: Surroundings) -> None:
        self._words = words
        self._around = around
        self.at = 0

    def _is(self, *names: str) -> bool:
        if self.at >= len(self._words):
            return False
        word = self._words[self.at]
        return not word.quoted and not word.paren and word.text in names

    def alternatives(self, depth: int) -> Answer:
        joints: list[_Joint] = []
        found = [self.negation(depth)]
        while self._is("AND", "OR"):
            joints.append(_both if self._is("AND") else _either)
            self.at += 1
            found.append(self.negation(depth))
        if len(set(joints)) < 2:
            return reduce(joints[0], found) if joints else found[0]
        # Up to 3.20 AND binds tighter than OR, then neither does, and of three operands in a row the last two may be
        # joined first: what all of them come to is sure.
        ways = {_tight(found, joints), _in_turn(found, joints), _in_pairs(found, joints)}
        return ways.pop() if len(ways) == 1 else UNKNOWN

    def negation(self, depth: int) -> Answer:
        negated = False
        while self._is("NOT") and self.at + 1 < len(self._words):
            self.at += 1
            negated = not negated
        found = self.test(depth)
        return opposite(found) if negated else found

    def test(self, depth: int) -> Answer:
        word = self._words[self.at]
        if word.paren and word.text == "(":
            if depth > _MOST_DEPTH:
                raise IndexError
            self.at += 1
            found = self.alternatives(depth + 1)
            if self._words[self.at] != Word(")", paren=True):
                raise IndexError
            self.at += 1
            return found
        following = self._words[self.at + 1] if self.at + 1 < len(self._words) else None
        binary = _BINARY.get(following.text) if following and not following.quoted and not following.paren else None
        if binary is not None and self.at + 2 < len(self._words):
            self.at += 3
            return self._compared(word, binary, self._words[self.at - 1])
        if not word.quoted and word.text in _UNARY and following is not None and not following.paren:
            self.at += 2
            return self._asked(word.text, following.text)
        self.at += 1
        return self._taken(word)

    def _taken(self, word: Word) -> Answer:
        if is_unknown(word.text):
            return UNKNOWN
        constant = truth_of(word.text)
        if constant is not None:
            return Answer(constant)
        if word.quoted:
            return FALSE
        value, open_ = self._around.variable(word.text)
        if value is not None and is_unknown(value):
            return UNKNOWN
        holds = value is not None and not is_off(value)
        return Answer(None, holds) if open_ else Answer(holds)

    def _asked(self, test: str, of: str) -> Answer:
        if is_unknown(of):
            return UNKNOWN
        if test == "DEFINED":
            value, open_ = self._around.variable(of)
            if value is not None and is_unknown(value) and (open_ or value.startswith(OPEN)):
                return UNKNOWN
            return Answer(None, value is not None) if open_ else Answer(value is not None)
        if test in ("EXISTS", "IS_DIRECTORY"):
            return Answer(self._around.exists(of, folder=test == "IS_DIRECTORY"))
        if test == "TARGET":
            return Answer(self._around.target(of))
        if test == "COMMAND":
            return Answer(self._around.command(of))
        return Answer(of.startswith("/")) if test == "IS_ABSOLUTE" else UNKNOWN

    def _valued(self, word: Word) -> tuple[str, bool]:
        """Return what a word of a comparison stands for: a variable's value or itself."""
        if word.quoted or is_unknown(word.text):
            return word.text, False
        value, open_ = self._around.variable(word.text)
        return (word.text, False) if value is None else (value, open_)

    def _compared(self, one: Word, compare: Callable[[str, str], bool | None], other: Word) -> Answer:
        left, open_left = self._valued(one)
        if compare is _matches:
            found = self._matched(left, other.text)
            return Answer(None, found) if open_left else Answer(found)
        if compare is _in_list:
            value, open_right = self._around.variable(other.text)
            right = value or ""
        else:
            right, open_right = self._valued(other)
        if is_unknown(left) or is_unknown(right):
            return UNKNOWN
        found = compare(left, right)
        return Answer(None, found) if open_left or open_right else Answer(found)

    def _matched(self, value: str, expression: str) -> bool | None:
        """Return whether a regular expression is found in a value; None where that is unknown."""
        if is_unknown(value) or is_unknown(expression):
            return None
        pattern = expression_of(expression)
        if pattern is None or not searchable(pattern, value):
            return None
        match = pattern.search(value)
        self._around.matched([match[0], *(group or "" for group in match.groups())] if match else ())
        return bool(match)


def _matches(_left: str, _right: str) -> bool:
    raise AssertionError  # pragma: no cover - its place in the table is what is used


def _in_list(left: str, right: str) -> bool:
    return left in items_of(right, empty=True)


def _numbers(compare: Callable[[float, float], bool]) -> Callable[[str, str], bool]:
    def compared(left: str, right: str) -> bool:
        one, other = number_of(left), number_of(right)
        return one is not None and other is not None and compare(one, other)

    return compared


def _versions(*accepted: int) -> Callable[[str, str], bool]:
    return lambda left, right: versions_compared(left, right) in accepted


_UNARY = frozenset(
    {"EXISTS", "COMMAND", "DEFINED", "TARGET", "POLICY", "TEST", "IS_DIRECTORY", "IS_ABSOLUTE", "IS_SYMLINK",
     "IS_READABLE", "IS_WRITABLE", "IS_EXECUTABLE"}
)  # fmt: skip
_BINARY: dict[str, Callable[[str, str], bool | None]] = {
    "EQUAL": _numbers(lambda one, other: one == other),
    "LESS": _numbers(lambda one, other: one < other),
    "GREATER": _numbers(lambda one, other: one > other),
    "LESS_EQUAL": _numbers(lambda one, other: one <= other),
    "GREATER_EQUAL": _numbers(lambda one, other: one >= other),
    "STREQUAL": lambda one, other: one == other,
    "STRLESS": lambda one, other: one < other,
    "STRGREATER": lambda one, other: one > other,
    "STRLESS_EQUAL": lambda one, other: one <= other,
    "STRGREATER_EQUAL": lambda one, other: one >= other,
    "PATH_EQUAL": lambda one, other: one.rstrip("/") == other.rstrip("/"),
    "VERSION_EQUAL": _versions(0),
    "VERSION_LESS": _versions(-1),
    "VERSION_GREATER": _versions(1),
    "VERSION_LESS_EQUAL": _versions(-1, 0),
    "VERSION_GREATER_EQUAL": _versions(0, 1),
    "MATCHES": _matches,
    "IN_LIST": _in_list,
    "IS_NEWER_THAN": lambda _one, _other: None,
}
