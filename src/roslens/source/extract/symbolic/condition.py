"""Conditions as they are written in code, and what holds where one or another of them does.

They are texts. Joined by ``and`` and ``or`` they are read as formulas of what stands between, which is not looked into:
``a``, ``not a``, ``a and (b or c)``. Rules of Boole then shorten them; what is too long for that is shown in part.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

_LONG = 150
"""So many signs of one of several conditions are shown."""
_MOST_TERMS = 12
_MOST_READ = 2000
_CUT = "…"
_PAIRS = {"(": ")", "[": "]", "{": "}"}
_OPPOSITES = {"no exception": "an exception"}

Literal = tuple[str, bool]
"""A condition that is not looked into, and whether it holds."""
Term = tuple[Literal, ...]
"""Conditions that hold together, each once, in the order in which they were written."""
Terms = tuple[Term, ...]
"""Of these one holds at least: none of it is never, one that is empty is always."""


def negated(condition: str) -> str:
    """Return the opposite of a condition as written."""
    for one, other in _OPPOSITES.items():
        if condition in (one, other):
            return other if condition == one else one
    if condition.startswith("not (") and _closes(condition, 4) == len(condition) - 1:
        return condition[5:-1]
    if " and " in condition or " or " in condition:
        return f"not ({condition})"
    return condition.removeprefix("not ") if condition.startswith("not ") else f"not {condition}"


def under_either(first: Sequence[str], second: Sequence[str]) -> tuple[str, ...]:
    """Return what holds wherever all of these conditions or all of those do."""
    common = tuple(one for one in first if one in second)
    rests = [[one for one in whole if one not in common] for whole in (first, second)]
    if not all(rests):
        return common
    terms = _shortened((*_read_all(rests[0]), *_read_all(rests[1]))) if _readable(rests) else None
    if terms is None:
        joined = [_joined(rest) for rest in rests]
        return *common, " or ".join(one if len(one) <= _LONG else f"{one[:_LONG]}{_CUT}" for one in joined)
    return tuple(dict.fromkeys((*common, *written(terms))))


def written(terms: Terms) -> tuple[str, ...]:
    """Return conditions as texts that hold together: what all terms have in common, and what is left of each."""
    if not terms or () in terms:
        return () if terms else ("never",)
    shared = [one for one in terms[0] if all(one in term for term in terms)]
    rests = [[_said(one) for one in term if one not in shared] for term in terms]
    either = " or ".join(" and ".join(rest) for rest in rests) if all(rests) else ""
    if len(either) > 2 * _LONG:
        either = f"{either[: 2 * _LONG]}{_CUT}"
    said = tuple(_said(one) for one in shared)
    return (*said, either) if either else said


def terms_of(condition: str) -> Terms | None:
    """Return a condition as terms of which one holds; None where they are too many."""
    if len(condition) > _MOST_READ:
        return None
    return _read(condition.strip(), holds=True)


def _readable(rests: Iterable[Sequence[str]]) -> bool:
    return all(_CUT not in one and terms_of(one) is not None for rest in rests for one in rest)


def _read_all(conditions: Sequence[str]) -> Terms:
    """Return terms of conditions that hold together; what would be too many is one that is not looked into."""
    found: Terms = ((),)
    for one in conditions:
        found = _both(found, terms_of(one) or (((one, True),),)) or (((_joined(conditions), True),),)
    return found


def _joined(conditions: Sequence[str]) -> str:
    many = len(conditions) > 1
    return " and ".join(f"({one})" if many and len(_parts(one, " or ")) > 1 else one for one in conditions)


def _read(text: str, *, holds: bool) -> Terms | None:
    either = _parts(text, " or ")
    pieces = either if len(either) > 1 else _parts(text, " and ")
    if len(pieces) > 1:
        read = [_read(piece, holds=holds) for piece in pieces]
        found: Terms | None = () if (len(either) > 1) is holds else ((),)
        for terms in read:
            if terms is None or found is None:
                return None
            found = _limited((*found, *terms)) if (len(either) > 1) is holds else _both(found, terms)
        return found
    if text.startswith("not "):
        return _read(text[4:].strip(), holds=not holds)
    if text.startswith("(") and _closes(text, 0) == len(text) - 1:
        return _read(text[1:-1].strip(), holds=holds)
    for one, other in _OPPOSITES.items():
        if text == other:
            text, holds = one, not holds
    return (((text, holds),),)


def _both(one: Terms, other: Terms) -> Terms | None:
    """Return terms that hold where one of these and one of those does; None where they are too many."""
    found = (tuple(dict.fromkeys((*left, *right))) for left in one for right in other)
    return _limited(tuple(term for term in found if _possible(term)))


def _limited(terms: Terms) -> Terms | None:
    unique = tuple(dict.fromkeys(terms))
    return unique if len(unique) <= _MOST_TERMS else None


def _possible(term: Term) -> bool:
    return not any((text, not holds) in term for text, holds in term)


def _shortened(terms: Terms) -> Terms | None:
    """Return equal terms, fewer and shorter; None where they are too many.

    ``a or a and b`` is ``a``, and ``a and b or a and c and not b`` is ``a and b or a and c``: what one term
    rules out for another one is left away.
    """
    if _limited(terms) is None:
        return None
    kept = [term for term in dict.fromkeys(terms) if _possible(term)]
    changed = True
    while changed:
        changed = False
        for place, term in enumerate(kept):
            for other in kept:
                shorter = _without_opposite(term, other)
                if shorter != term:
                    kept[place], changed = shorter, True
                    term = shorter
        kept = [
            term
            for place, term in enumerate(kept)
            if not any(
                set(other) < set(term) or (set(other) == set(term) and before < place)
                for before, other in enumerate(kept)
            )
        ]
    return tuple(kept)


def _without_opposite(term: Term, other: Term) -> Term:
    """Return a term without the one condition whose opposite, with conditions of the term, is the other term."""
    outside = [one for one in other if one not in term]
    if len(outside) != 1:
        return term
    opposite = (outside[0][0], not outside[0][1])
    return tuple(one for one in term if one != opposite)


def _said(literal: Literal) -> str:
    return literal[0] if literal[1] else negated(literal[0])


def _parts(text: str, separator: str) -> list[str]:
    """Return the parts of a text between words that stand outside of brackets and quotes."""
    if separator not in text:
        return [text]
    found, begin, place = [], 0, 0
    while place < len(text):
        sign = text[place]
        if sign in _PAIRS or sign == '"':
            place = _closes(text, place) + 1
            if not place:
                return [text]
        elif text.startswith(separator, place):
            found.append(text[begin:place].strip())
            begin = place = place + len(separator)
        else:
            place += 1
    return [*found, text[begin:].strip()]


def _closes(text: str, begin: int) -> int:
    """Return where the bracket or quote that opens at a place is closed; -1 where it is not."""
    if text[begin] == '"':
        return text.find('"', begin + 1)
    open_, place = [], begin
    while place < len(text):
        sign = text[place]
        if sign == '"':
            place = text.find('"', place + 1)
            if place < 0:
                return -1
        elif sign in _PAIRS:
            open_.append(_PAIRS[sign])
        elif open_ and sign == open_[-1]:
            open_.pop()
            if not open_:
                return place
        place += 1
    return -1
