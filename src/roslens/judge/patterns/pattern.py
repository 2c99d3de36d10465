"""Patterns on the names of entities.

``*`` is any text within one segment (no ``/``), ``**`` any text, ``?`` one character but ``/``, ``{a,b}`` one of these
(they nest), a backslash takes the next character as it is; everything else, brackets too, stands for itself. A pattern
that begins with ``re:`` is a regular expression in Python's syntax that has to match the whole name.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache

from roslens.judge.patterns.automaton import ANY, Automaton, Letters

REGULAR_EXPRESSION = "re:"
MAX_NESTED = 20
"""Alternatives inside each other."""

MAX_STARS = 100
"""Of one pattern: each may keep a state busy for every character of a name."""

_NOT_SLASH = Letters(frozenset("/"), negated=True)
_SPECIAL_SIGN = re.compile(r"[*?{},\\]")
_SPECIAL = re.compile(r"\*+|[?{},\\]")


class Pattern:
    """What names may look like; made by :meth:`parse`.

    Attributes:
        text: as written.
        literal: the only name that matches, where there are no wildcards; else None.
        head: a text with which every matching name begins.
        tail: a text with which every matching name ends.
        core: a text that is somewhere in every matching name.
        automaton: what accepts matching names; None for a literal.
        leaf: pattern of the last segment of every matching name, where there surely is one; else None.
    """

    __slots__ = ("automaton", "core", "head", "leaf", "literal", "tail", "text")

    def __init__(
        self, text: str, automaton: Automaton | None, plain: Sequence[str] = (), leaf: Pattern | None = None
    ) -> None:
        """Keep the automaton of a pattern, or None for a name alone; ``plain`` are head, core and tail."""
        self.text = text
        self.head, self.core, self.tail = plain or ("", "", "")
        self.literal = self.core if automaton is None else None
        self.automaton = automaton
        self.leaf = leaf

    @staticmethod
    def parse(text: str) -> Pattern:
        """Read a pattern.

        Raises:
            ValueError: the text is none; the message states why.
        """
        return _parse(text)

    def __repr__(self) -> str:
        return f"Pattern.parse({self.text!r})"

    def __str__(self) -> str:
        """Return the pattern as written."""
        return self.text

    def matches(self, name: str) -> bool:
        """Whether the whole of ``name`` matches; linear in its length."""
        if self.automaton is None:
            return name == self.literal
        # Most names fail by their plain text already, which is much cheaper to see.
        return (
            self.core in name
            and name.startswith(self.head)
            and name.endswith(self.tail)
            and self.automaton.accepts(name)
        )

    def intersects(self, other: Pattern) -> bool:
        """Whether some name matches both: exact for globs, and may be a false yes for regular expressions."""
        if self.literal is not None:
            return other.matches(self.literal)
        if other.literal is not None:
            return self.matches(other.literal)
        heads = self.head.startswith(other.head) or other.head.startswith(self.head)
        tails = self.tail.endswith(other.tail) or other.tail.endswith(self.tail)
        if not heads or not tails:
            return False
        # Cheaper than the search below, and excludes most pairs of patterns in practice.
        if self.leaf is not None and other.leaf is not None and not self.leaf.intersects(other.leaf):
            return False
        if self.automaton is None or other.automaton is None:
            return True
        return self.automaton.meets(other.automaton)


@lru_cache(maxsize=4096)
def _parse(text: str) -> Pattern:
    if not text:
        raise ValueError("the pattern is empty")
    if text.startswith(REGULAR_EXPRESSION):
        from roslens.judge.patterns.regular_expression import automaton_of

        return Pattern(text, automaton_of(text.removeprefix(REGULAR_EXPRESSION)))
    pieces = _pieces(text)
    if all(isinstance(piece, _Plain) for piece in pieces):
        name = "".join(pieces)
        return Pattern(text, None, (name, name, name))
    stars = sum(piece in {"*", "**"} for piece in pieces)
    if stars > MAX_STARS:
        raise ValueError(f"{stars} stars in the pattern {text[:60]!r}, expected up to {MAX_STARS}")
    automaton = Automaton()
    automaton.end = _Glob(text, pieces, automaton).build()
    runs = _plain_runs(pieces)
    return Pattern(text, automaton, (runs[0], max(runs, key=len), runs[-1]), _leaf(pieces))


class _Plain(str):
    """Text that stands for itself; wildcards and braces are bare ``str``."""

    __slots__ = ()


def _pieces(text: str) -> list[str]:
    """Cut a pattern into plain texts and special signs."""
    pieces: list[str] = []
    at = 0
    while found := _SPECIAL.search(text, at):
        if found.start() > at:
            pieces.append(_Plain(text[at : found.start()]))
        at = found.end()
        sign = found[0]
        if sign == "\\":
            if at == len(text):
                raise ValueError(f"the pattern {text!r} ends in a backslash; write `\\\\` for one that is meant")
            pieces.append(_Plain(text[at]))
            at += 1
        elif len(sign) > 2:
            raise ValueError(f"{sign!r} in the pattern {text!r}; write `**` for any text")
        else:
            pieces.append(sign)
    if at < len(text):
        pieces.append(_Plain(text[at:]))
    return _outer_commas(pieces)


def _outer_commas(pieces: list[str]) -> list[str]:
    """Take commas outside braces as plain text."""
    depth = 0
    found: list[str] = []
    for piece in pieces:
        special = not isinstance(piece, _Plain)
        depth += (piece == "{") - (piece == "}") if special else 0
        found.append(_Plain(",") if special and piece == "," and depth <= 0 else piece)
    return found


def _plain_runs(pieces: list[str]) -> list[str]:
    """Return the plain texts before, between and behind the special signs outside braces."""
    runs = [""]
    depth = 0
    for piece in pieces:
        if isinstance(piece, _Plain):
            runs[-1] += piece if depth == 0 else ""
            continue
        depth += (piece == "{") - (piece == "}")
        runs.append("")
    return runs


def _leaf(pieces: list[str]) -> Pattern | None:
    """Return the pattern behind the last ``/`` that stands outside braces, where none can come behind it."""
    found: list[str] = []
    for piece in reversed(pieces):
        if not isinstance(piece, _Plain):
            if piece not in {"*", "?"}:
                return None
            found.append(piece)
            continue
        _, slash, behind = piece.rpartition("/")
        found.append(_SPECIAL_SIGN.sub(r"\\\g<0>", behind))
        if slash:
            text = "".join(reversed(found))
            return _parse(text) if text else None
    return None


class _Glob:
    """Builds the automaton of one glob."""

    def __init__(self, text: str, pieces: list[str], automaton: Automaton) -> None:
        self._text = text
        self._pieces = pieces
        self._automaton = automaton
        self._at = 0

    def build(self) -> int:
        """Build it and return the accepting state."""
        end = self._sequence(0, 0)
        if self._at < len(self._pieces):
            raise ValueError(f"'}}' without '{{' in the pattern {self._text!r}; write `\\}}` for one that is meant")
        return end

    def _sequence(self, state: int, depth: int) -> int:
        while self._at < len(self._pieces):
            piece = self._pieces[self._at]
            if isinstance(piece, _Plain):
                for char in piece:
                    state = self._automaton.edge(state, Letters(frozenset(char)))
            elif piece == "{":
                state = self._alternatives(state, depth + 1)
                continue
            elif piece in "},":
                break
            elif piece == "?":
                state = self._automaton.edge(state, _NOT_SLASH)
            else:
                state = self._automaton.loop(state, _NOT_SLASH if piece == "*" else ANY)
            self._at += 1
        return state

    def _alternatives(self, state: int, depth: int) -> int:
        if depth > MAX_NESTED:
            raise ValueError(f"more than {MAX_NESTED} braces inside each other in the pattern {self._text[:60]!r}")
        end = self._automaton.state()
        while True:
            self._at += 1
            start = self._automaton.state()
            self._automaton.free[state].append(start)
            self._automaton.free[self._sequence(start, depth)].append(end)
            if self._at == len(self._pieces):
                raise ValueError(f"'{{' without '}}' in the pattern {self._text!r}; write `\\{{` for one that is meant")
            if self._pieces[self._at] == "}":
                self._at += 1
                return end
