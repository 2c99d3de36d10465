"""A name that matches several patterns at once: the example that proves that two constraints can meet."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from itertools import combinations

from roslens.judge.patterns.automaton import Automaton, Letters
from roslens.judge.patterns.pattern import Pattern

MAX_STATES = 5_000
"""Looked at before a name is taken to exist without having been found."""

_FRESH = "abcdefghijklmnopqrstuvwxyz0123456789_ÿ"


def common_name(included: Sequence[Pattern], excluded: Sequence[Pattern] = ()) -> str | None:
    """Return a short name that matches all of ``included`` and none of ``excluded``, None where there is none.

    Exact for globs. With regular expressions only names of printable ASCII, ``é`` and the characters that the patterns
    mention are looked at. An empty text says that the search was given up: there may be such a name.
    """
    for pattern in included:
        name = pattern.literal
        if name is not None:
            fits = all(one.matches(name) for one in included) and not any(one.matches(name) for one in excluded)
            return name if fits else None
    if not all(one.intersects(other) for one, other in combinations(included, 2)):
        return None
    chars = _letters([*included, *excluded])
    automata = [_automaton(pattern) for pattern in (*included, *excluded)]
    return _search(automata, len(included), chars)


def _automaton(pattern: Pattern) -> Automaton:
    if pattern.automaton is not None:
        return pattern.automaton
    automaton = Automaton()
    state = 0
    for char in pattern.literal or "":
        state = automaton.edge(state, Letters(frozenset(char)))
    automaton.end = state
    return automaton


def _letters(patterns: Sequence[Pattern]) -> list[str]:
    """Return one character of each kind that the patterns distinguish."""
    sets = {letters for pattern in patterns for edges in _automaton(pattern).edges for letters, _ in edges}
    mentioned = sorted({"/"}.union(*(letters.chars for letters in sets)))
    samples = [*_FRESH, *mentioned]
    if any(letters.test is not None for letters in sets):
        samples += [*map(chr, range(0x20, 0x7F)), "é"]
    kinds: dict[tuple[bool, ...], str] = {}
    for char in samples:
        kinds.setdefault(tuple(char in letters for letters in sets), char)
    return list(kinds.values())


def _search(automata: Sequence[Automaton], included: int, chars: Sequence[str]) -> str | None:
    """Search breadth first, so that the shortest name is found."""
    start = tuple(automaton.closure((0,)) for automaton in automata)
    waiting = deque([(start, "")])
    seen = {start}
    while waiting:
        states, name = waiting.popleft()
        accepted = [automaton.end in state for automaton, state in zip(automata, states, strict=True)]
        if name and all(accepted[:included]) and not any(accepted[included:]):
            return name
        for char in chars:
            following = tuple(automaton.after(state, char) for automaton, state in zip(automata, states, strict=True))
            if all(following[:included]) and following not in seen:
                if len(seen) >= MAX_STATES:
                    return ""
                seen.add(following)
                waiting.append((following, name + char))
    return None
