"""How certain a finding is where what it rests on is not certain, and in words why."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

import msgspec

from roslens.model.configuration import Clause, Proof
from roslens.model.weight.consequence import Certainty

_STEPS = {"certain": 0, "likely": 1, "possible": 2}
_BY_RANK = (Certainty.HEURISTIC, Certainty.LIKELY, Certainty.PROVEN)
_APART = "no launch file states that these nodes run together under these names"


class Doubt(msgspec.Struct, frozen=True):
    """Why a finding may be none, each reason in words; false where there is none."""

    reasons: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        """Whether there is any."""
        return bool(self.reasons)

    def __str__(self) -> str:
        """Write it as the end of a message."""
        return f" In doubt: {'; '.join(self.reasons)}." if self.reasons else ""


def weighed(
    certainty: Certainty | None, proofs: Iterable[Proof | None], conditions: Iterable[str] = (), *, more: str = ""
) -> tuple[Certainty, Doubt]:
    """Return a certainty lowered by doubt, and why; nothing is false where nothing is in doubt.

    What is likely, and what only holds under conditions, is one step less; what is possible is heuristic.

    Args:
        certainty: where all is certain; None is likely.
        proofs: of what the finding rests on.
        conditions: that must hold.
        more: a further doubt, one step.
    """
    steps, words = 0, []
    for proof in proofs:
        if proof is not None and (step := _STEPS.get(proof.sure, 2)):
            steps = max(steps, step)
            how = f": {proof.how}" if proof.how else ""
            words.append(f"{proof.sure} only{how} ({proof.place})")
    held = list(dict.fromkeys(conditions))
    if held:
        steps = max(steps, 1)
        words.append("only if " + " and ".join(f"`{one}`" for one in held))
    if more:
        steps += 1
        words.append(more)
    lowered = _BY_RANK[max(0, (certainty or Certainty.LIKELY).rank - steps)]
    return lowered, Doubt(tuple(dict.fromkeys(words)))


def weighed_apart(doubt: Doubt) -> tuple[Certainty, Doubt]:
    """Return the certainty of a finding about nodes that may never run together."""
    return Certainty.HEURISTIC, Doubt((_APART, *doubt.reasons))


def doubt_of(proofs: Iterable[Proof | None], conditions: Iterable[str] = ()) -> int:
    """Return how far from certain something is, to choose the clearest of several: 0 is certain."""
    steps = [_STEPS.get(proof.sure, 2) for proof in proofs if proof is not None]
    return max(steps, default=0) * 2 + bool(list(conditions))


_COMPARED = (
    # Python, and eval of launch files, with what stands around it: ``python(', mode, ' == 'a')``.
    re.compile(r"(?P<of>.+?)\s*==\s*(?P<quote>['\"])(?P<value>[^'\"]*)(?P=quote)(?P<end>\W*)"),
    re.compile(r"(?P<of>.+?)\s*==\s*(?P<value>-?\d+(?:\.\d+)?)(?P<end>\W*)"),
    # What code compares with a part that is not known: ``{parameter mode} == a``.
    re.compile(r"(?P<of>\{[^{}]+\}) == (?P<value>[^\s{}]+)(?P<end>)"),
    re.compile(r"(?P<of>equals\(.+), (?P<value>[^,(){}]+)(?P<end>\))"),
    re.compile(r"(?P<of>\$\(equals .+?)\s+(?P<quote>['\"]?)(?P<value>[^\s'\"$()]+)(?P=quote)(?P<end>\))"),
)
"""Conditions that compare something with a text or number, as they are written."""


def _equalities(clauses: Iterable[Clause]) -> Iterator[re.Match[str]]:
    """Yield the comparisons that hold together, those that ``and`` joins too."""
    for clause in clauses:
        if not clause.holds or " or " in clause.text:
            continue
        for part in clause.text.split(" and "):
            yield from (found for form in _COMPARED if (found := form.fullmatch(part)))


def _needed(found: re.Match[str]) -> tuple[str, str]:
    """Return what is compared, with what stands around it, and the value that it needs."""
    return f"{found['of']}\0{found['end']}", found["value"]


def exclude_each_other(first: Iterable[Clause], second: Iterable[Clause]) -> bool:
    """Return whether a condition of one is the opposite of one of the other, or needs another value of the same thing.

    ``mode == 'a'`` and ``mode == 'b'`` cannot both hold.
    """
    one, other = [*first], [*second]
    asked = {(clause.text, clause.holds) for clause in one}
    if any((clause.text, not clause.holds) in asked for clause in other):
        return True
    needed = dict(map(_needed, _equalities(one)))
    return any(needed.get(subject, value) != value for subject, value in map(_needed, _equalities(other)))
