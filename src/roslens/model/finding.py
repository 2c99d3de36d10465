"""Rules and their occurrences."""

from __future__ import annotations

from hashlib import blake2b
from math import inf, isnan

import msgspec

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence, supposed
from roslens.model.weight.severity import Severity

__all__ = ["MOST_EXCESS", "Finding", "RuleInfo", "Severity", "fingerprint"]

MOST_EXCESS = 1e9
"""What is further beyond its bound is not distinguished, so that infinite values have a number too."""


class RuleInfo(msgspec.Struct, frozen=True, omit_defaults=True):
    """What a rule is about; everything ``roslens explain`` and the rules page show.

    ``precision`` is the share of its findings that were true when ``read`` of them were read; 0 where nobody did.
    ``bad`` is an example that it reports, ``good`` the same as it should be. ``fix`` says what ``roslens check --fix``
    does about them; empty where it does nothing. ``consequence`` and ``certainty`` are what the severity follows from;
    None where its tool declares none. ``unproven`` is a heuristic rule that nobody has confirmed on repositories that
    it was not written for.
    """

    id: str
    title: str
    description: str
    severity: Severity = Severity.WARNING
    tags: tuple[str, ...] = ()
    rationale: str = ""
    tool: str = ""
    languages: tuple[str, ...] = ()
    scope: str = "file"
    url: str = ""
    precision: float = 0.0
    fix: str = ""
    consequence: Consequence | None = None
    certainty: Certainty | None = None
    unproven: bool = False
    read: int = 0
    bad: str = ""
    good: str = ""

    @property
    def weight(self) -> tuple[Consequence, Certainty]:
        """Consequence and certainty; what its severity lets suppose where its tool declares none."""
        return _weight(self.consequence, self.certainty, self.severity)


class Finding(msgspec.Struct, frozen=True, omit_defaults=True):
    """One occurrence of a rule.

    Lines and columns are 1-based, 0 means unknown; ``entity`` is the text form of the id of the
    innermost entity known. A finding that a quality model makes carries the ``value``, the
    ``quantity``, the broken ``bound`` and the ``model``. One that stands for several of one cause
    names the ``others``, each with its place; one that holds for several entities alike has the rest in ``also``.
    ``witnesses`` are the ids of the other rules, of whichever tool, that reported the same at the same place.
    ``edits`` mend it without a change of what the code does otherwise; none where that takes a person.
    ``doubts`` are the reasons why it may be none; they stand at the end of the message too. ``breach`` of one that a
    quality model makes says which limit is broken, as its message does before it names the entity; where several of
    one entity are one, it is part of the message alone. ``consequence`` and ``certainty`` are those of this occurrence,
    whose certainty may be lower than the rule's; None where its tool declares none.
    """

    rule: str
    severity: Severity
    message: str
    path: str = ""
    line: int = 0
    column: int = 0
    end_line: int = 0
    end_column: int = 0
    entity: str = ""
    tags: tuple[str, ...] = ()
    tool: str = ""
    fingerprint: str = ""
    quantity: str = ""
    value: float | None = None
    bound: float | None = None
    model: str = ""
    gated: bool = True
    others: tuple[str, ...] = ()
    also: tuple[str, ...] = ()
    witnesses: tuple[str, ...] = ()
    edits: tuple[Edit, ...] = ()
    doubts: tuple[str, ...] = ()
    breach: str = ""
    consequence: Consequence | None = None
    certainty: Certainty | None = None

    @property
    def weight(self) -> tuple[Consequence, Certainty]:
        """Consequence and certainty; what its severity lets suppose where its tool declares none."""
        return _weight(self.consequence, self.certainty, self.severity)

    @property
    def excess(self) -> float:
        """How many times the bound the value is, or the bound the value where it is too low; 0 without a bound.

        A bound or value of 0 counts as 1, so that what is 5 where nothing is allowed is 5 times too much.
        """
        if self.value is None or self.bound is None:
            return 0.0
        value, bound = _as_float(self.value), _as_float(self.bound)
        if isnan(value) or isnan(bound):
            return 0.0
        high, low = max(value, bound), min(value, bound)
        return 1.0 if high == low == inf else min(high / (low if low > 0 else 1.0), MOST_EXCESS)


def _weight(
    consequence: Consequence | None, certainty: Certainty | None, severity: Severity
) -> tuple[Consequence, Certainty]:
    if consequence is None or certainty is None:
        return supposed(severity)
    return consequence, certainty


def _as_float(number: float) -> float:
    """Return a number as a float; an integer that none holds is without bound."""
    try:
        return float(number)
    except OverflowError:
        return inf if number > 0 else -inf


def fingerprint(rule: str, place: str, context: str = "", ordinal: int = 0) -> str:
    """Return 16 hexadecimal digits that stay the same while code moves up and down a file.

    Args:
        rule: id of the rule.
        place: text form of the innermost entity's id, or the path.
        context: the flagged source text with its white space squeezed; empty for a finding about
            a whole entity.
        ordinal: counts findings that agree in all the others, from 0, in order of their lines.
    """
    squeezed = " ".join(context.split())
    text = "\0".join((rule, place, squeezed, str(ordinal)))
    return blake2b(text.encode("utf-8", "surrogateescape"), digest_size=8).hexdigest()
