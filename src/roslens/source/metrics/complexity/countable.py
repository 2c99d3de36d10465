"""What of a function is counted, by the user's choice about lambdas and ``#if`` arms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import Control, FunctionFacts


def countable(facts: FunctionFacts, counting: CountingSettings) -> Mapping[str, int]:
    """Return how often each role occurs in the part of the function that is counted.

    Without ``counting.lambdas`` what is inside lambdas is left out (the lambda itself stays); without
    ``counting.alternatives`` what stands in second and later arms of ``#if`` is. Where both are off, a
    call or statement that is in a lambda *and* in such an arm is taken off twice (never below zero):
    facts hold no places of calls. Decisions and jumps are exact.
    """
    if counting.lambdas and counting.alternatives:
        return facts.counts
    counts = dict(facts.counts)
    if not counting.lambdas:
        _subtract(counts, facts.lambda_counts)
    if not counting.alternatives:
        _subtract(counts, facts.alternative_counts)
    if not counting.lambdas and not counting.alternatives:
        _restore_what_is_in_both(counts, facts.control)
    return {role: number for role, number in counts.items() if number > 0}


def countable_control(facts: FunctionFacts, counting: CountingSettings) -> Sequence[Control]:
    """Return the events of the control structure that are counted, see :func:`countable`."""
    if counting.lambdas and counting.alternatives:
        return facts.control
    inside = _inside_lambdas(facts.control)
    return [
        event
        for event, in_lambda in zip(facts.control, inside, strict=True)
        if (counting.lambdas or not in_lambda) and (counting.alternatives or not event.alternative)
    ]


def _subtract(counts: dict[str, int], part: Mapping[str, int]) -> None:
    for role, number in part.items():
        counts[role] = counts.get(role, 0) - number


def _restore_what_is_in_both(counts: dict[str, int], control: Sequence[Control]) -> None:
    for event, in_lambda in zip(control, _inside_lambdas(control), strict=True):
        if in_lambda and event.alternative:
            counts[event.role] = counts.get(event.role, 0) + 1


def _inside_lambdas(control: Sequence[Control]) -> list[bool]:
    inside: list[bool] = []
    outermost: int | None = None
    for event in control:
        if outermost is not None and event.depth <= outermost:
            outermost = None
        inside.append(outermost is not None)
        if outermost is None and event.role == "lambda":
            outermost = event.depth
    return inside
