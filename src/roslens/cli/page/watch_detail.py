"""What `roslens watch --serve` tells of one entity: every signal, and what each constraint says."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from roslens.cli.page.half_lines import encodable
from roslens.cli.page.watch_screen import value_text
from roslens.dashboard.live.detail import Detail, Judgement, Value
from roslens.judge.ranges.amount import parse_limits
from roslens.live.explain.links import links_text
from roslens.live.system.shown_rows import badge
from roslens.live.system.tree import SystemView
from roslens.live.window.signals import BY_KEY
from roslens.model.verdict import State, Verdict

OBSERVED = {
    "inside": "counted inside the node",
    "protocol": "reported by the middleware",
    "tap": "received by a tap",
    "recording": "from the recording",
    "agent": "sampled on its host",
    "scripted": "scripted",
}
"""How something was observed, in words."""
_WORSE = {state: place for place, state in enumerate(State)}


def detail_of(
    entity: str, whole: SystemView, standing: Iterable[Verdict], when: str, clock: Callable[[float], str]
) -> Detail | None:
    """Return all that is known of an entity by the text form of its id; None where it is not there.

    Args:
        entity: its id.
        whole: the system.
        standing: verdicts of all entities.
        when: the instant, as people read it.
        clock: how a time is written.
    """
    part = _find(entity, whole)
    about = [one for one in standing if encodable(str(one.entity)) == entity]
    if part is None and not about:
        return None
    kind, _, name = entity.partition(":")
    ranked = sorted(about, key=lambda one: (-_WORSE[one.state], -one.severity.rank, one.expectation))
    return Detail(
        entity=entity,
        name=encodable(part.name) if part is not None and part.name else name,
        kind=kind,
        when=when.strip(),
        observed=OBSERVED.get(part.observer, part.observer) if part is not None else "",
        judgements=tuple(_judgement(one, clock) for one in ranked),
        values=_values(part),
        below=badge(part) if part is not None else "",
    )


def _find(entity: str, whole: SystemView) -> SystemView | None:
    waiting: list[SystemView] = list(whole.children)
    while waiting:
        part = waiting.pop()
        if encodable(part.id) == entity:
            return part
        waiting += part.children
    return None


def _values(part: SystemView | None) -> tuple[Value, ...]:
    known = part.values if part is not None else {}
    found: Sequence[tuple[str, float]] = [(key, known[key]) for key in BY_KEY if key in known]
    return tuple(
        Value(key, BY_KEY[key].title, value_text(key, float(f"{value:.4g}")), BY_KEY[key].text)
        for key, value in found
        if math.isfinite(value)
    )


def limits_of(one: Verdict) -> tuple[float | None, float | None]:
    """Return the least and the greatest value that are fine, in the unit of the signal; None is no such bound."""
    signal = BY_KEY.get(one.quantity)
    if signal is None or not one.range:
        return None, None
    try:
        found = parse_limits(one.range, signal.unit).range
    except ValueError:
        # Ranges of texts, and what a newer reference may write.
        return None, None
    return found.minimum, found.maximum


def _judgement(one: Verdict, clock: Callable[[float], str]) -> Judgement:
    signal = BY_KEY.get(one.quantity)
    shown = "" if one.value is None else value_text(one.quantity, one.value) if signal else f"{one.value:g}"
    return Judgement(
        expectation=encodable(one.expectation),
        title=signal.title if signal else one.quantity,
        value=shown,
        expected=encodable(one.range),
        state=one.state.value,
        severity=one.severity.value,
        since=clock(one.since).strip(),
        evidence=encodable(one.evidence),
        cause=encodable(one.cause),
        leads_to=encodable(one.leads_to),
        why=encodable(links_text(one.entity, one.why)) if one.why else "",
        text=encodable(one.text),
        where=encodable(one.where),
    )
