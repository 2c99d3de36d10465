"""A system at one instant as the document of the live page: rows, alerts, what happened, all of bearable length."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import lru_cache
from hashlib import blake2b
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.page.board_page import MOST_ALERTS
from roslens.cli.page.half_lines import encodable, ends_of
from roslens.cli.page.watch_causes import causes_of
from roslens.cli.page.watch_graph import GraphPicture
from roslens.cli.page.watch_screen import nameless, urgency, value_text
from roslens.dashboard.live.snapshot import UNJUDGED, VERSION, Alert, Happening, Row, Snapshot
from roslens.live.publish.diagnostics import sentence
from roslens.live.system.worth_a_row import badge, not_judged, worth_a_row
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.graph import Change, Event, Graph
from roslens.model.verdict import Verdict

if TYPE_CHECKING:
    from roslens.live.system.tree import SystemView

COLUMNS = (
    ("rate", "Rate"),
    ("largest_gap", "Gap"),
    ("latency", "Latency"),
    ("loss", "Loss"),
    ("bandwidth", "Bandwidth"),
    ("cpu", "CPU"),
    ("memory", "Memory"),
)
_GRAVITY = {severity.value: severity.rank for severity in Severity}
_PROCESS = f"{EntityKind.PROCESS.value}:"
_LONGEST_NAME = 200
_LONGEST_TEXT = 600


def document(
    view: SystemView,
    standing: Sequence[Verdict],
    graph: Graph,
    picture: GraphPicture,
    *,
    time: float,
    clock: Callable[[float], str],
    title: str,
    live: bool,
    cost: str,
    happened: Iterable[Happening],
    failures: tuple[str, ...] = (),
) -> Snapshot:
    """Return a system at one instant as the live page shows it, be it now or once."""
    rows = tuple(_rows(view.children, 0, ""))
    return Snapshot(
        version=VERSION,
        time=time,
        when=clock(time),
        title=shown_name(title),
        live=live,
        state=view.worst.value if view.worst else UNJUDGED,
        counts=view.counts,
        unjudged=not_judged(view),
        cost=cost,
        columns=tuple(column for column in COLUMNS if any(column[0] in row.shown for row in rows)),
        rows=rows,
        alerts=_alerts(standing, clock),
        causes=causes_of(standing, shown_text),
        picture=picture.of(graph, rows, standing),
        happened=tuple(happened),
        failures=failures,
    )


def bounded(found: Snapshot) -> Snapshot:
    """Return a snapshot with the first alerts of very many, and how many there are."""
    follow = sum(len(one.follows) for one in found.alerts)
    alerts = (
        msgspec.structs.replace(one, follows=one.follows[:MOST_ALERTS]) if len(one.follows) > MOST_ALERTS else one
        for one in found.alerts[:MOST_ALERTS]
    )
    return msgspec.structs.replace(found, alerts=tuple(alerts), wrong=len(found.alerts), follow=follow)


def told_of(event: Event) -> bool:
    """Whether to tell an event: programs come and go all the time; of those that hold nodes the nodes tell it."""
    return not (event.entity.startswith(_PROCESS) and event.change in (Change.APPEARED, Change.VANISHED))


def event_line(event: Event, clock: Callable[[float], str]) -> Happening:
    """Return a change of the graph as the page tells it."""
    text = shown_text(event.entity)
    what, detail = event.change.value, shown_text(event.detail)
    return Happening(event.time, clock(event.time), what, text, text.partition(":")[2], "", detail)


def verdict_line(one: Verdict, clock: Callable[[float], str]) -> Happening:
    """Return a change of a verdict as the page tells it."""
    entity = shown_text(str(one.entity))
    detail = shown_text(sentence(one)) if one.state.bad or one.of_observer else _title(one.quantity)
    name = shown_name(one.entity.name)
    return Happening(one.since, clock(one.since), f"is {one.state.value}", entity, name, one.state.value, detail)


def shown_name(name: str) -> str:
    """Return a name from outside as text that can be encoded, and short enough to show."""
    return _cut(name, _LONGEST_NAME)


def shown_text(text: str) -> str:
    """Return a text from outside as text that can be encoded, and short enough to show."""
    return _cut(text, _LONGEST_TEXT)


def _cut(text: str, longest: int) -> str:
    if len(text) > longest:
        text = f"{text[: longest * 2 // 3]}…{text[-(longest // 3) :]}"
    return encodable(text)


def _rows(parts: Iterable[SystemView], depth: int, above: str) -> Iterator[Row]:
    for part in parts:
        if not worth_a_row(part):
            continue
        key = _key(above, part.id)
        values = {name: value for name, value in part.values.items() if math.isfinite(value)}
        shown = {name: _shown(name, float(f"{values[name]:.3g}")) for name, _ in COLUMNS if name in values}
        yield Row(
            key,
            encodable(part.id),
            _name(part),
            part.kind,
            depth,
            part.state.value if part.state else UNJUDGED,
            part.counts,
            values,
            shown,
            part.observer,
            part.worst.value if part.worst else UNJUDGED,
            badge(part),
        )
        yield from _rows(part.children, depth + 1, key)


@lru_cache(maxsize=65536)
def _key(above: str, entity: str) -> str:
    return blake2b(f"{above}\0{entity}".encode("utf-8", "replace"), digest_size=6).hexdigest()


@lru_cache(maxsize=65536)
def _shown(key: str, value: float) -> str:
    return value_text(key, value)


def _name(part: SystemView) -> str:
    if not part.name:
        return nameless(part)
    if part.kind == "connection":
        _, _, subscriber = ends_of(part.id)
        return f"→ {shown_name(subscriber) or 'anybody'}"
    return shown_name(part.name)


def _title(quantity: str) -> str:
    signal = BY_KEY.get(quantity)
    return signal.title.lower() if signal else quantity


def _alerts(verdicts: Sequence[Verdict], clock: Callable[[float], str]) -> tuple[Alert, ...]:
    """Return the first causes, latest last, each with what follows from it."""
    silent = {str(one.entity) for one in verdicts if one.of_observer}
    shown = (one for one in verdicts if one.wrong or one.cause in silent)
    bad = sorted(shown, key=urgency)
    causes = {str(one.entity): place for place, one in reversed(list(enumerate(bad))) if not one.cause}
    followers: dict[int, list[Alert]] = {}
    firsts = []
    for place, one in enumerate(bad):
        cause = causes.get(one.cause) if one.cause else None
        if cause is None:
            firsts.append(place)
        else:
            followers.setdefault(cause, []).append(_alert(one, clock, ()))
    return tuple(_alert(bad[place], clock, tuple(followers.get(place, ()))) for place in firsts)


def _alert(one: Verdict, clock: Callable[[float], str], follows: tuple[Alert, ...]) -> Alert:
    entity = str(one.entity)
    name = one.entity.name
    if one.entity.kind is EntityKind.CONNECTION:
        topic, publisher, subscriber = ends_of(entity)
        name = f"{publisher or '?'} → {topic} → {subscriber or 'anybody'}"
    return Alert(
        key=_key(entity, one.expectation),
        entity=encodable(entity),
        name=shown_name(name),
        kind=one.entity.kind.value,
        state=one.state.value,
        # What an error follows from matters as much as the error.
        severity=max([one.severity.value, *(other.severity for other in follows)], key=_GRAVITY.__getitem__),
        sentence=shown_text(sentence(msgspec.structs.replace(one, cause=""))),
        since=one.since,
        when=clock(one.since),
        cause=encodable(one.cause),
        group=shown_name(one.group),
        where=shown_text(one.where),
        evidence=shown_text(one.evidence),
        follows=follows,
    )
