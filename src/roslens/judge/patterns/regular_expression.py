"""Regular expressions as automata, so that no name, however hostile, takes longer than its length.

Python's own parser reads the expression; what no automaton can do (references to groups, look-around) is refused.
"""

from __future__ import annotations

import re
import sys
import warnings
from importlib import import_module
from typing import Any

from roslens.judge.patterns.automaton import Automaton, Letters

MAX_STATES = 1_000
"""Of the automaton of one expression; `(a{40}){40}` would have more."""

_FLAGS = re.IGNORECASE | re.ASCII | re.DOTALL | re.UNICODE | re.VERBOSE


def automaton_of(expression: str) -> Automaton:
    """Return what accepts the names that ``expression`` matches as a whole.

    Raises:
        ValueError: it is not a regular expression, or not one that an automaton can hold; the message states why.
    """
    if not expression:
        raise ValueError("the regular expression is empty")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            tree = _parser().parse(expression)
    except (re.error, Warning, RecursionError, OverflowError) as error:
        raise ValueError(f"{expression[:60]!r} is not a regular expression: {error}") from None
    flags = tree.state.flags
    if flags & ~_FLAGS:
        raise ValueError(f"the regular expression {expression[:60]!r} has flags; only (?i), (?a), (?s), (?x) go here")
    items = list(tree)
    # A name is always matched as a whole: `^` and `$` at its ends say nothing new.
    if items and str(items[0][1]) in {"AT_BEGINNING", "AT_BEGINNING_STRING"}:
        del items[0]
    if items and str(items[-1][1]) in {"AT_END", "AT_END_STRING"}:
        del items[-1]
    automaton = Automaton()
    try:
        automaton.end = _Builder(expression, automaton, flags).sequence(items, 0)
    except RecursionError:
        raise ValueError(f"the regular expression {expression[:60]!r} nests too deeply") from None
    return automaton


def _parser() -> Any:
    # Type checkers know neither name in all versions of Python.
    return import_module("re._parser" if sys.version_info >= (3, 11) else "sre_parse")


class _Builder:
    """Builds the automaton of one expression from the tree of Python's parser."""

    def __init__(self, expression: str, automaton: Automaton, flags: int) -> None:
        self._expression = expression
        self._automaton = automaton
        self._flags = flags & (re.IGNORECASE | re.ASCII | re.DOTALL)

    def sequence(self, items: Any, state: int) -> int:
        """Add ``items`` behind ``state`` and return the state behind them."""
        for operation, argument in items:
            state = self._item(str(operation), argument, state)
            if len(self._automaton.edges) > MAX_STATES:
                raise ValueError(f"the regular expression {self._expression[:60]!r} repeats too much; use `*` or `+`")
        return state

    def _item(self, operation: str, argument: Any, state: int) -> int:
        if operation in {"LITERAL", "NOT_LITERAL", "ANY", "IN"}:
            return self._automaton.edge(state, self._letters(operation, argument))
        if operation == "BRANCH":
            return self._branch(argument[1], state)
        if operation == "SUBPATTERN" and not argument[1] and not argument[2]:
            return self.sequence(argument[3], state)
        if operation in {"MAX_REPEAT", "MIN_REPEAT"}:
            least, most, body = argument
            return self._repeat(least, most, body, state)
        name = {
            "GROUPREF": "a reference to a group",
            "GROUPREF_EXISTS": "a reference to a group",
            "ASSERT": "look-ahead or look-behind",
            "ASSERT_NOT": "negative look-ahead or look-behind",
            "SUBPATTERN": "flags for a part",
            "AT": "an anchor inside",
        }.get(operation, operation.lower().replace("_", " "))
        raise ValueError(
            f"the regular expression {self._expression[:60]!r} has {name}, which cannot be matched in one pass; "
            "use `without` to leave names out"
        )

    def _branch(self, branches: Any, state: int) -> int:
        end = self._automaton.state()
        for branch in branches:
            start = self._automaton.state()
            self._automaton.free[state].append(start)
            self._automaton.free[self.sequence(branch, start)].append(end)
        return end

    def _repeat(self, least: Any, most: Any, body: Any, state: int) -> int:
        for _ in range(int(least)):
            state = self.sequence(body, state)
        if str(most) == "MAXREPEAT":
            start = self._automaton.state()
            self._automaton.free[state].append(start)
            self._automaton.free[self.sequence(body, start)].append(start)
            return start
        end = self._automaton.state()
        for _ in range(int(most) - int(least)):
            self._automaton.free[state].append(end)
            state = self.sequence(body, state)
        self._automaton.free[state].append(end)
        return end

    def _letters(self, operation: str, argument: Any) -> Letters:
        if operation == "LITERAL" and not self._flags & re.IGNORECASE:
            return Letters(frozenset(chr(argument)))
        if operation == "NOT_LITERAL" and not self._flags & re.IGNORECASE:
            return Letters(frozenset(chr(argument)), negated=True)
        if operation == "ANY":
            return Letters(frozenset() if self._flags & re.DOTALL else frozenset("\n"), negated=True)
        parts = argument if operation == "IN" else [(operation, argument)]
        source = "".join(_member(str(kind), value) for kind, value in parts)
        fits = re.compile(f"[{source}]", self._flags).match
        return Letters(test=lambda char: fits(char) is not None)


def _member(kind: str, value: Any) -> str:
    """Return a part of a set of characters as source text."""
    if kind == "NEGATE":
        return "^"
    if kind == "RANGE":
        return f"\\U{value[0]:08x}-\\U{value[1]:08x}"
    if kind == "CATEGORY":
        category = str(value).removeprefix("CATEGORY_")
        letter = {"DIGIT": "d", "SPACE": "s", "WORD": "w"}[category.removeprefix("NOT_")]
        return f"\\{letter.upper() if category.startswith('NOT_') else letter}"
    if kind == "NOT_LITERAL":
        return f"^\\U{value:08x}"
    return f"\\U{value:08x}"
