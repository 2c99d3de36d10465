"""Macros that a project names by regular expressions: each word of a file is read once, whatever the expression is."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from roslens.judge.patterns.automaton import Automaton
from roslens.judge.patterns.regular_expression import automaton_of

_WORD = re.compile(rb"[A-Za-z0-9_]+")
_LONGEST = 200
"""Longer words are no names of macros."""

_REMEMBERED = 10_000


class OwnMacros:
    """The macros of a project by their kind; of a name that has two kinds the first counts."""

    def __init__(self, patterns: Mapping[str, Iterable[str]]) -> None:
        """Compile.

        Raises:
            ValueError: a name is not a regular expression, or none that is matched in one pass.
        """
        self._kinds: list[tuple[str, Automaton]] = [
            (kind, _automaton(name)) for kind, names in patterns.items() for name in names
        ]
        self._known: dict[bytes, str] = {}

    def find(self, content: bytes) -> list[tuple[int, int, str]]:
        """Return where names stand, start and end, with their kinds."""
        if not self._kinds:
            return []
        found = ((*match.span(), self._kind(match[0])) for match in _WORD.finditer(content))
        return [one for one in found if one[2]]

    def _kind(self, word: bytes) -> str:
        kind = self._known.get(word)
        if kind is None:
            name = word.decode("ascii")
            kind = ""
            if len(word) <= _LONGEST:
                kind = next((kind for kind, automaton in self._kinds if automaton.accepts(name)), "")
            if len(self._known) < _REMEMBERED:
                self._known[word] = kind
        return kind


def _automaton(name: str) -> Automaton:
    try:
        automaton = automaton_of(name)
    except ValueError as error:
        raise ValueError(f"{name!r} is not a pattern for the name of a macro: {error}") from error
    if automaton.accepts(""):
        raise ValueError(f"{name!r} is not a pattern for the name of a macro: it fits an empty name")
    return automaton
