"""What follows from a finding and how certain that is; the severity is a table of the two."""

from __future__ import annotations

from enum import Enum

from roslens.model.weight.severity import Severity


class Consequence(str, Enum):
    """What happens if a finding is left as it is, from worst to mildest."""

    STOPS_BUILD = "stops the build"
    STOPS_START = "stops the start"
    WRONG = "wrong at run time"
    MAY_BE_WRONG = "may be wrong at run time"
    HARD_TO_MAINTAIN = "hard to maintain"
    STYLE = "style"

    @property
    def rank(self) -> int:
        """5 for what stops the build, 0 for style."""
        return 5 - _CONSEQUENCES.index(self)

    @property
    def grave(self) -> bool:
        """Whether the robot does not build, does not start or does not do what it should."""
        return self in _GRAVE


class Certainty(str, Enum):
    """How certain it is that a finding is true and has its consequence, from most to least.

    ``proven``: the platform itself refuses it (XML, rcl, rosidl, launch, CMake, the compiler), or the definition of
    the language decides it. ``likely``: at least nine in ten are true. ``heuristic``: it often indicates a mistake.
    """

    PROVEN = "proven"
    LIKELY = "likely"
    HEURISTIC = "heuristic"

    @property
    def rank(self) -> int:
        """2 for proven, 0 for heuristic."""
        return 2 - _CERTAINTIES.index(self)


_CONSEQUENCES = tuple(Consequence)
_CERTAINTIES = tuple(Certainty)
_GRAVE = frozenset((Consequence.STOPS_BUILD, Consequence.STOPS_START, Consequence.WRONG))

_NOTE, _WARNING, _ERROR = Severity.NOTE, Severity.WARNING, Severity.ERROR
_TABLE = {
    # Columns: proven, likely, heuristic. An error is proven: a gate that fails on it is never wrong.
    Consequence.STOPS_BUILD: (_ERROR, _WARNING, _WARNING),
    Consequence.STOPS_START: (_ERROR, _WARNING, _WARNING),
    Consequence.WRONG: (_ERROR, _WARNING, _WARNING),
    Consequence.MAY_BE_WRONG: (_WARNING, _WARNING, _NOTE),
    Consequence.HARD_TO_MAINTAIN: (_WARNING, _NOTE, _NOTE),
    Consequence.STYLE: (_NOTE, _NOTE, _NOTE),
}


def severity_of(consequence: Consequence, certainty: Certainty, *, unproven: bool = False) -> Severity:
    """Return the severity of a finding.

    Args:
        consequence: what follows from it.
        certainty: how certain that is.
        unproven: nobody has confirmed the rule on repositories that it was not written for; a heuristic finding of
            it is a note.
    """
    if unproven and certainty is Certainty.HEURISTIC:
        return Severity.NOTE
    return _TABLE[consequence][_CERTAINTIES.index(certainty)]


def weight_text(consequence: Consequence, certainty: Certainty, *, unproven: bool = False) -> str:
    """Return both in words: ``wrong at run time, likely``.

    Args:
        consequence: of a rule or finding.
        certainty: of it.
        unproven: nobody has confirmed the rule on repositories that it was not written for.
    """
    return f"{consequence.value}, {'unproven' if unproven else certainty.value}"


def supposed(severity: Severity) -> tuple[Consequence, Certainty]:
    """Return what is supposed of a finding of which only the severity is known, so that its severity stays the same.

    Such are findings of plug-ins and tools that declare no consequence, and of runs that were stored without it.
    """
    return _SUPPOSED[severity]


_SUPPOSED = {
    Severity.ERROR: (Consequence.WRONG, Certainty.PROVEN),
    Severity.WARNING: (Consequence.MAY_BE_WRONG, Certainty.LIKELY),
    Severity.NOTE: (Consequence.HARD_TO_MAINTAIN, Certainty.LIKELY),
}
