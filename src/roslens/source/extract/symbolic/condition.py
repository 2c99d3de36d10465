"""What holds where one condition or another does: opposites, and rules of Boole that shorten what is joined.

Written conditions are not looked into. Formulas of them are brought into terms of which one holds, the terms are
shortened, and what they have in common is separated from what is left of each.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from roslens.model.configuration import Clause
from roslens.source.extract.symbolic.text import And, Atom, Condition, Conditions, NoException, Not, Or, Written

NO_EXCEPTION = NoException()
ALWAYS = And(())
NEVER = Or(())
_LONG = 150
"""So many signs of one of several conditions are shown."""
_MOST_TERMS = 12
_MOST_ATOMS = 200
"""A condition of more is not looked into: what is found by turns of loops may double with each."""
_CUT = "…"

Literal = tuple[Atom, bool]
"""A condition that is not looked into, and whether it holds."""
Term = tuple[Literal, ...]
"""Conditions that hold together, each once, in the order in which they were written."""
Terms = tuple[Term, ...]
"""Of these one holds at least: none of it is never, one that is empty is always."""


def negated(condition: Condition) -> Condition:
    """Return the opposite of a condition."""
    return condition.of if type(condition) is Not else Not(condition)


def all_of(conditions: Sequence[Condition]) -> Condition:
    """Return the condition that all of several hold; of one it is that."""
    return conditions[0] if len(conditions) == 1 else bounded(And(tuple(_flat(And, conditions))))


def any_of(*conditions: Condition) -> Condition:
    """Return the condition that one of several holds."""
    return conditions[0] if len(conditions) == 1 else bounded(Or(tuple(_flat(Or, conditions))))


def as_written(conditions: Iterable[Condition]) -> tuple[str, ...]:
    """Return conditions as reports show them; what is too long is shown in part."""
    return tuple(map(_shown, conditions))


def clauses_of(conditions: Iterable[Condition]) -> tuple[Clause, ...]:
    """Return conditions as what has to hold and what must not, in the words of :func:`as_written`."""
    return tuple(
        Clause(_shown(one.of), holds=False) if isinstance(one, Not) else Clause(_shown(one)) for one in conditions
    )


def bounded(condition: Condition) -> Condition:
    """Return a condition, and in place of one that is too large what is shown of it, which is not looked into."""
    return condition if _size(condition) <= _MOST_ATOMS else Written(_shown(condition)[: 2 * _LONG] + _CUT)


def under_either(first: Conditions, second: Conditions) -> Conditions:
    """Return what holds wherever all of these conditions or all of those do."""
    common = tuple(one for one in first if one in second)
    rests = [[one for one in whole if one not in common] for whole in (first, second)]
    if not all(rests):
        return common
    terms = _shortened((*_read_all(rests[0]), *_read_all(rests[1])))
    if terms is None:
        return *common, any_of(*map(all_of, rests))
    return tuple(dict.fromkeys((*common, *formulas_of(terms))))


def formulas_of(terms: Terms) -> Conditions:
    """Return conditions that hold together: what all terms have in common, and what is left of each."""
    if not terms or () in terms:
        return () if terms else (NEVER,)
    shared = [one for one in terms[0] if all(one in term for term in terms)]
    rests = [[_formula(one) for one in term if one not in shared] for term in terms]
    found = tuple(map(_formula, shared))
    return (*found, any_of(*map(all_of, rests))) if all(rests) else found


def terms_of(condition: Condition) -> Terms | None:
    """Return a condition as terms of which one holds; None where they are too many."""
    return _read(condition, holds=True)


def atoms_of(condition: Condition) -> Iterator[Atom]:
    """Yield what a condition is made of, in the order in which it is written."""
    match condition:
        case And(of=parts) | Or(of=parts):
            for one in parts:
                yield from atoms_of(one)
        case Not(of=one):
            yield from atoms_of(one)
        case _:
            yield condition


def _size(condition: Condition) -> int:
    return sum(1 for _ in atoms_of(condition))


def _flat(kind: type[And | Or], conditions: Iterable[Condition]) -> Iterator[Condition]:
    for one in conditions:
        match one:
            case kind():
                yield from one.of
            case _:
                yield one


def _shown(condition: Condition) -> str:
    if type(condition) is not Or:
        return str(condition)
    whole = str(condition)
    return whole if len(whole) <= 2 * _LONG else f"{whole[: 2 * _LONG]}{_CUT}"


def _read_all(conditions: Sequence[Condition]) -> Terms:
    """Return terms of conditions that hold together; what would be too many is left out, and so may hold or not."""
    found: Terms = ((),)
    for one in conditions:
        found = _both(found, terms_of(one) or ((_opaque(one),),)) or ((_opaque(all_of(conditions)),),)
    return found


def _opaque(condition: Condition) -> Literal:
    """Return a condition as one that is not looked into."""
    return (Written(str(condition)), True)


def _read(condition: Condition, *, holds: bool) -> Terms | None:
    match condition:
        case Not(of=inner):
            return _read(inner, holds=not holds)
        case And(of=parts) | Or(of=parts):
            either = (type(condition) is Or) is holds
            found: Terms | None = () if either else ((),)
            for one in parts:
                terms = _read(one, holds=holds)
                if terms is None or found is None:
                    return None
                found = _limited((*found, *terms)) if either else _both(found, terms)
            return found
        case _:
            return (((condition, holds),),)


def _both(one: Terms, other: Terms) -> Terms | None:
    """Return terms that hold where one of these and one of those does; None where they are too many."""
    found = (tuple(dict.fromkeys((*left, *right))) for left in one for right in other)
    return _limited(tuple(term for term in found if _possible(term)))


def _limited(terms: Terms) -> Terms | None:
    unique = tuple(dict.fromkeys(terms))
    return unique if len(unique) <= _MOST_TERMS else None


def _possible(term: Term) -> bool:
    return not any((atom, not holds) in term for atom, holds in term)


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


def _formula(literal: Literal) -> Condition:
    return literal[0] if literal[1] else Not(literal[0])
