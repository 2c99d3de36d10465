"""Why what is wrong is wrong: the verdicts of a session as the small graph of the live page."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from roslens.dashboard.live.causes import CausePicture, Step, cause_picture
from roslens.model.verdict import State, Verdict

_WORSE = (State.ABSENT, State.HIGH, State.LOW, State.UNKNOWN, State.SUSPENDED, State.OK)


def causes_of(standing: Sequence[Verdict], shown: Callable[[str], str]) -> CausePicture:
    """Return the graph of the faults that others explain; ``shown`` makes texts from outside fit to be shown."""
    explained = [one for one in standing if one.why and (one.state.bad or one.wrong)]
    if not explained:
        return CausePicture()
    states: dict[str, State] = {}
    for one in standing:
        entity = shown(str(one.entity))
        before = states.get(entity)
        if before is None or _WORSE.index(one.state) < _WORSE.index(before):
            states[entity] = one.state
    ways = (tuple(_way(one, shown)) for one in explained)
    # The list of alerts has these as first causes: both show the same.
    alerts = {shown(str(one.entity)) for one in standing if one.state.bad and not one.cause}
    return cause_picture(ways, {entity: state.value for entity, state in states.items()}, alerts)


def _way(verdict: Verdict, shown: Callable[[str], str]) -> Iterator[Step]:
    effect = shown(str(verdict.entity))
    for link in verdict.why:
        cause = shown(link.entity)
        yield Step(effect, cause, shown(link.relation), shown(link.evidence))
        effect = cause
