"""A system at one instant as the document of the live page: rows, alerts, what happened, all of bearable length."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.page.board_page import MOST_ALERTS
from roslens.cli.page.half_lines import encodable, ends_of
from roslens.cli.page.row_list import COLUMNS, RowList, row_key, shown_name, shown_text
from roslens.cli.page.watch_causes import causes_of
from roslens.cli.page.watch_graph import GraphPicture
from roslens.cli.page.watch_screen import urgency
from roslens.dashboard.live.snapshot import UNJUDGED, VERSION, Alert, Happening, Picture, Snapshot
from roslens.live.explain.causes import LATE_S
from roslens.live.publish.diagnostics import verdict_message
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.graph import Change, Event, Graph
from roslens.model.verdict import State, Verdict

if TYPE_CHECKING:
    from roslens.live.system.tree import SystemView

_GRAVITY = {severity.value: severity.rank for severity in Severity}
_PROCESS = f"{EntityKind.PROCESS.value}:"


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
    recorded: bool,
    cost: str,
    happened: Iterable[Happening],
    failures: tuple[str, ...] = (),
    row_list: RowList | None = None,
    drawn: Picture | None = None,
) -> Snapshot:
    """Return a system at one instant as the live page shows it, be it now or once.

    Rows of what did not change since ``row_list`` made the ones before are the same again. The picture is ``drawn``
    where that is given, because nobody sees it.
    """
    row_list = row_list or RowList()
    rows = row_list.of(view, recorded=recorded)
    # What is fine is no alert, nothing explains it, and no node is bad by it.
    uneasy = [one for one in standing if one.state is not State.OK]
    return Snapshot(
        version=VERSION,
        time=time,
        when=clock(time),
        title=shown_name(title),
        live=live,
        state=view.worst.value if view.worst else UNJUDGED,
        counts=view.counts,
        unjudged=row_list.unjudged,
        cost=cost,
        columns=tuple(column for column in COLUMNS if column[0] in row_list.columns),
        rows=rows,
        alerts=_alerts(uneasy, clock),
        causes=causes_of(standing, shown_text),
        picture=drawn or picture.of(graph, rows, uneasy),
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


def reported_of(event: Event) -> bool:
    """Whether to tell an event: programs come and go all the time; of those that hold nodes the nodes tell it."""
    return not (event.entity.startswith(_PROCESS) and event.change in (Change.APPEARED, Change.VANISHED))


def event_line(event: Event, clock: Callable[[float], str]) -> Happening:
    """Return a change of the graph as the page tells it."""
    text = shown_text(event.entity)
    what, detail = event.change.value, shown_text(event.detail)
    return Happening(event.time, clock(event.time), what, text, text.partition(":")[2], "", detail)


def verdict_line(one: Verdict, clock: Callable[[float], str]) -> Happening:
    """Return a change of a verdict as the page lists it, at the time of the change: the fault began before it."""
    entity = shown_text(str(one.entity))
    detail = shown_text(verdict_message(one)) if one.state.bad or one.of_observer else _title(one.quantity)
    name = shown_name(one.entity.name)
    return Happening(one.time, clock(one.time), f"is {one.state.value}", entity, name, one.state.value, detail)


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
            followers.setdefault(cause, []).append(_alert(one, clock, (), _before(one, bad[cause], clock)))
    return tuple(_alert(bad[place], clock, tuple(followers.get(place, ()))) for place in firsts)


def _before(one: Verdict, cause: Verdict, clock: Callable[[float], str]) -> str:
    """Return since when both are so, where something was wrong before the node was gone or stopped that explains it."""
    states = {"presence": "absent", "stopped": "stopped"}
    if cause.quantity not in states or cause.since - one.since <= LATE_S:
        return ""
    node = "its node" if one.entity.kind is EntityKind.TOPIC else cause.entity.name
    began, ended = clock(one.since).strip(), clock(cause.since).strip()
    return f"; out of range since {began}, {node} {states[cause.quantity]} since {ended}"


def _alert(one: Verdict, clock: Callable[[float], str], follows: tuple[Alert, ...], before: str = "") -> Alert:
    entity = str(one.entity)
    name = one.entity.name
    if one.entity.kind is EntityKind.CONNECTION:
        topic, publisher, subscriber = ends_of(entity)
        name = f"{publisher or '?'} → {topic} → {subscriber or 'anybody'}"
    return Alert(
        key=row_key(entity, one.expectation),
        entity=encodable(entity),
        name=shown_name(name),
        kind=one.entity.kind.value,
        state=one.state.value,
        # What an error follows from matters as much as the error.
        severity=max([one.severity.value, *(other.severity for other in follows)], key=_GRAVITY.__getitem__),
        message=shown_text(verdict_message(msgspec.structs.replace(one, cause="")) + before),
        since=one.since,
        when=clock(one.since),
        cause=encodable(one.cause),
        group=shown_name(one.group),
        where=shown_text(one.where),
        evidence=shown_text(one.evidence),
        follows=follows,
    )
