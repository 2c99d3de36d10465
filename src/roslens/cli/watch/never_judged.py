"""What a watch never judged, which is no passed test: how many verdicts, why, and what to do about it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from roslens.model.entity import EntityId
from roslens.model.failure import Failure
from roslens.model.finding import Severity
from roslens.model.verdict import State, Verdict

HOW_TO_OBSERVE = "Start nodes through `roslens run`, or give --tap '**'; watch for longer than grace (5 s by default)"


class JudgedOnce:
    """Remembers which verdicts were ever more than unknown."""

    def __init__(self) -> None:
        self._judged: set[tuple[EntityId, str]] = set()

    def add(self, changes: Iterable[Verdict]) -> None:
        """Take verdicts that changed."""
        self._judged.update((one.entity, one.expectation) for one in changes if one.state.judged)

    def never(self, standing: Iterable[Verdict]) -> list[Verdict]:
        """Return those that are unknown and never were anything else; the gravest first."""
        found = [
            one
            for one in standing
            if one.state is State.UNKNOWN and not one.of_observer and (one.entity, one.expectation) not in self._judged
        ]
        return sorted(found, key=lambda one: (-one.severity.rank, one.entity, one.expectation))


def failures_of(never: Sequence[Verdict], of: int) -> tuple[Failure, ...]:
    """Return that nothing was judged, or that an error could not have been noticed; nothing of what matters less.

    Args:
        never: verdicts that were never judged, the gravest first.
        of: how many verdicts there are.
    """
    if not never:
        return ()
    one = never[0]
    such = f"such as {one.entity} {one.quantity}" + (f" since {one.evidence}" if one.evidence else "")
    if len(never) == of:
        said = f"nothing could be judged: every verdict stayed unknown, {such}"
        return (Failure("watch", said, "values of what the reference is about", HOW_TO_OBSERVE),)
    grave = sum(verdict.severity is Severity.ERROR for verdict in never)
    if not grave:
        return ()
    verdicts = "1 verdict of severity error was" if grave == 1 else f"{grave} verdicts of severity error were"
    return (Failure("watch", f"{verdicts} never judged, {such}", "all of them judged", HOW_TO_OBSERVE),)


def summary_of(never: Sequence[Verdict], of: int) -> str:
    """Return ``12 of 22 never judged, such as …: start nodes through …``; empty where all was judged."""
    if not never:
        return ""
    one = never[0]
    why = f" ({one.evidence})" if one.evidence else ""
    return f"{len(never)} of {of} never judged, such as {one.entity} {one.quantity}{why}. {HOW_TO_OBSERVE}."
