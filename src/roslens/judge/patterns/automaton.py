"""Automata over characters: they read a name once, from left to right, whatever the pattern and the name are.

A pattern becomes a nondeterministic automaton with silent steps (Thompson's construction); the deterministic one is
built while names are read, as far as they need it, so that a character costs one look-up.

Source: R. Cox, Regular Expression Matching Can Be Simple And Fast, 2007.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import msgspec

_MOST_STEPS = 20_000
"""Remembered steps of one deterministic automaton; beyond, they are forgotten before the next name is read."""


class Letters(msgspec.Struct, frozen=True):
    """A set of characters: ``chars``, or with ``negated`` every other one.

    ``test`` stands for both where a set cannot be written down (the word characters of a regular expression).
    """

    chars: frozenset[str] = frozenset()
    negated: bool = False
    test: Callable[[str], bool] | None = None

    def __contains__(self, char: str) -> bool:
        """Whether ``char`` is one of them."""
        if self.test is not None:
            return self.test(char)
        return (char in self.chars) is not self.negated

    def meets(self, other: Letters) -> bool:
        """Whether some character may be in both; certain for sets without a ``test``."""
        if self.test is not None or other.test is not None:
            return True
        if self.negated:
            return other.negated or not other.chars <= self.chars
        if other.negated:
            return not self.chars <= other.chars
        return not self.chars.isdisjoint(other.chars)


ANY = Letters(negated=True)


class Automaton:
    """A nondeterministic automaton under construction, and the deterministic one grown from it.

    State 0 is where reading begins; ``end`` must be set to the state in which a whole name is accepted.
    """

    __slots__ = ("_accepting", "_ids", "_remembered", "_sets", "_steps", "edges", "end", "free")

    def __init__(self) -> None:
        self.edges: list[list[tuple[Letters, int]]] = []
        self.free: list[list[int]] = []
        self.end = self.state()
        self._ids: dict[frozenset[int], int] = {}
        self._sets: list[frozenset[int]] = []
        self._steps: list[dict[str, int]] = []
        self._accepting: list[bool] = []
        self._remembered = 0

    def state(self) -> int:
        """Add a state and return its number."""
        self.edges.append([])
        self.free.append([])
        return len(self.edges) - 1

    def edge(self, origin: int, letters: Letters) -> int:
        """Add a step over one of ``letters`` to a new state, and return that."""
        target = self.state()
        self.edges[origin].append((letters, target))
        return target

    def loop(self, origin: int, letters: Letters) -> int:
        """Add a new state in which any number of ``letters`` may be read, and return it."""
        target = self.state()
        self.free[origin].append(target)
        self.edges[target].append((letters, target))
        return target

    def accepts(self, text: str) -> bool:
        """Whether all of ``text`` is accepted; the time is linear in its length."""
        if not self._sets or self._remembered > _MOST_STEPS:
            self._restart()
        at = 0
        for char in text:
            following = self._steps[at].get(char)
            at = self._step(at, char) if following is None else following
            if at < 0:
                return False
        return self._accepting[at]

    def closure(self, states: Iterable[int]) -> frozenset[int]:
        """Return ``states`` and all that silent steps lead to from them."""
        found = set(states)
        waiting = list(found)
        while waiting:
            for target in self.free[waiting.pop()]:
                if target not in found:
                    found.add(target)
                    waiting.append(target)
        return frozenset(found)

    def after(self, states: frozenset[int], char: str) -> frozenset[int]:
        """Return the states in which ``char`` leaves it; none where it is not accepted."""
        return self.closure(target for state in states for letters, target in self.edges[state] if char in letters)

    def meets(self, other: Automaton) -> bool:
        """Whether some text is accepted by both: a search over pairs of states."""
        seen = {(0, 0)}
        waiting = [(0, 0)]
        while waiting:
            mine, theirs = waiting.pop()
            if mine == self.end and theirs == other.end:
                return True
            pairs = [(target, theirs) for target in self.free[mine]]
            pairs += [(mine, target) for target in other.free[theirs]]
            pairs += [
                (one, two)
                for letters, one in self.edges[mine]
                for others, two in other.edges[theirs]
                if letters.meets(others)
            ]
            fresh = [pair for pair in pairs if pair not in seen]
            seen.update(fresh)
            waiting += fresh
        return False

    def _step(self, at: int, char: str) -> int:
        states = self.after(self._sets[at], char)
        following = self._number(states) if states else -1
        self._steps[at][char] = following
        self._remembered += 1
        return following

    def _number(self, states: frozenset[int]) -> int:
        number = self._ids.setdefault(states, len(self._sets))
        if number == len(self._sets):
            self._sets.append(states)
            self._steps.append({})
            self._accepting.append(self.end in states)
        return number

    def _restart(self) -> None:
        self._ids.clear()
        self._sets.clear()
        self._steps.clear()
        self._accepting.clear()
        self._remembered = 0
        self._number(self.closure((0,)))
