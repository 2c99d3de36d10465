"""What ``roslens top`` writes: rows of the tree, alerts, details; pure, so that it is tested without a terminal."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import msgspec

from roslens.cli.page.watch_screen import GLYPHS, NOT_JUDGED
from roslens.cli.top.past import BARS, PLAIN_BARS, Past, sparkline
from roslens.dashboard.live.detail import Detail
from roslens.dashboard.live.snapshot import UNJUDGED, Alert, Row, Snapshot
from roslens.model.verdict import State
from roslens.report.writing.terminal import Terminal

SPARK = 24
_SPARK_SIGNALS = ("rate", "cpu", "latency", "bandwidth", "memory")
_ROLES = {"fine": "green", "warning": "yellow", "error": "red", "quiet": "dim"}


class Look(msgspec.Struct, frozen=True):
    """What of a snapshot is shown.

    Attributes:
        closed: keys of rows whose parts are hidden.
        filter: what a name must have in it, in small letters; empty for all.
        worse: whether only rows are shown that are, or have below them, what is worse than ok.
    """

    closed: frozenset[str] = frozenset()
    filter: str = ""
    worse: bool = False


class Line(msgspec.Struct, frozen=True):
    """A row as it is shown: its key, its entity, the cells, the style of its state, and whether it has parts."""

    key: str
    entity: str
    cells: tuple[str, ...]
    style: str
    parts: bool


_BAD = frozenset(state.value for state in State if state.bad)


def visible(snapshot: Snapshot, look: Look) -> tuple[tuple[Row, bool], ...]:
    """Return the rows that are shown, each with whether it has parts; what is above one that fits stays."""
    rows = snapshot.rows
    fits = [_fits(row, look) for row in rows]
    above: list[int] = []
    kept: set[int] = set()
    for place, row in enumerate(rows):
        del above[row.depth :]
        if fits[place]:
            kept.update((*above, place))
        above.append(place)
    found: list[tuple[Row, bool]] = []
    hidden_below: int | None = None
    for place, row in enumerate(rows):
        if hidden_below is not None and row.depth > hidden_below:
            continue
        hidden_below = None
        parts = place + 1 < len(rows) and rows[place + 1].depth > row.depth
        # Who filters wants to see what fits, whatever was closed before.
        if parts and row.key in look.closed and not look.filter:
            hidden_below = row.depth
        if place in kept:
            found.append((row, parts))
    return tuple(found)


def _fits(row: Row, look: Look) -> bool:
    if look.worse and row.state not in _BAD:
        return False
    return look.filter in row.name.lower() or look.filter in row.entity.lower()


def columns(snapshot: Snapshot, most: int) -> tuple[tuple[str, str], ...]:
    """Return the key and heading of the values that are shown beside names: the first ones, ``most`` of them."""
    return snapshot.columns[: max(0, most)]


def lines(
    snapshot: Snapshot, look: Look, past: Past, shown: Sequence[tuple[str, str]], *, terminal: Terminal
) -> tuple[Line, ...]:
    """Return the rows of the tree: state, name, values, and a sparkline of the first value that has one."""
    return tuple(_line(row, look, past, shown, terminal, parts=parts) for row, parts in visible(snapshot, look))


def _line(
    row: Row, look: Look, past: Past, shown: Sequence[tuple[str, str]], terminal: Terminal, *, parts: bool
) -> Line:
    mark = ("▸ " if row.key in look.closed else "▾ ") if parts else "  "
    if not terminal.unicode:
        mark = mark.replace("▸", "+").replace("▾", "-")
    name = f"{'  ' * row.depth}{mark}{terminal.clean(row.name)}"
    if row.below:
        name += f"  ({terminal.clean(row.below)})"
    sign, style = sign_of(row.state, terminal)
    values = (row.shown.get(key, "") for key, _ in shown)
    return Line(row.key, row.entity, (sign, name, *values, spark_of(row, past, terminal)), style, parts)


def sign_of(state: str, terminal: Terminal) -> tuple[str, str]:
    """Return sign and word of a state, and its style."""
    sign, plain, role = GLYPHS[None if state == UNJUDGED else State(state)]
    word = NOT_JUDGED if state == UNJUDGED else state
    return f"{sign if terminal.unicode else plain} {word}", _ROLES[role]


def spark_of(row: Row, past: Past, terminal: Terminal, width: int = 8) -> str:
    """Return the sparkline of the most informative value of a row."""
    for key in _SPARK_SIGNALS:
        if any(value is not None for value in past.series(row.entity, key)):
            return sparkline(past.series(row.entity, key), width, bars_of(terminal))
    return ""


def bars_of(terminal: Terminal) -> str:
    """Return the bars that a terminal can show."""
    return BARS if terminal.unicode else PLAIN_BARS


def alert_lines(alerts: Sequence[Alert], terminal: Terminal) -> tuple[tuple[str, str, str], ...]:
    """Return entity, text and style of each first cause, and under it of what follows from it."""
    found: list[tuple[str, str, str]] = []
    for one in alerts:
        found.append(_alert(one, terminal, ""))
        arrow = "  ↳ " if terminal.unicode else "  > "
        found += [_alert(other, terminal, arrow) for other in one.follows]
    return tuple(found)


def _alert(one: Alert, terminal: Terminal, before: str) -> tuple[str, str, str]:
    sign, _ = sign_of(one.state, terminal)
    style = "red" if one.severity == "error" else "yellow"
    text = f"{before}{sign}  {one.when.strip()}  {terminal.clean(one.name)}: {terminal.clean(one.message)}"
    return one.entity, text, style


def head(snapshot: Snapshot | None, title: str, problem: str) -> str:
    """Return the first line: what is watched, how it stands, what it costs; or why it is not known."""
    if snapshot is None:
        return f"{title}  {problem or 'waiting for the first look'}"
    counts = ", ".join(f"{count} {state}" for state, count in snapshot.counts.items() if count) or "nothing is judged"
    if snapshot.unjudged and snapshot.counts:
        counts += f", {snapshot.unjudged} {NOT_JUDGED}"
    text = f"{snapshot.title}  {snapshot.when.strip()}  {counts}"
    return f"{text}  NOT CURRENT: {problem}" if problem else f"{text}  costs {snapshot.cost}"


def detail_lines(found: Detail, past: Past, terminal: Terminal) -> tuple[str, ...]:
    """Return all that is known of an entity: its verdict for each constraint, and every signal with a sparkline."""
    clean = terminal.clean
    first = f"{found.kind} {clean(found.name)}"
    reported = [first + (f"  ({clean(found.below)})" if found.below else "")]
    if found.observed:
        reported.append(f"observed: {clean(found.observed)}, {found.when}")
    for one in found.judgements:
        value = f" {one.value}" if one.value else ""
        sign, _ = sign_of(one.state, terminal)
        reported.append(f"{sign}: {clean(one.title)}{value}, expected {clean(one.expected)}, since {one.since}")
        reported += [f"    {clean(text)}" for text in (one.evidence, one.why, one.text, one.where) if text]
    if not found.judgements:
        reported.append("no constraint of the reference is about it")
    width = max((len(one.title) for one in found.values), default=0)
    for signal in found.values:
        bars = sparkline(past.series(found.entity, signal.key), SPARK, bars_of(terminal))
        reported.append(f"{clean(signal.title):<{width}}  {signal.shown:>12}  {bars}".rstrip())
    return tuple(reported)


def entities(shown: Collection[Line]) -> dict[str, int]:
    """Return the first place of each entity among the lines."""
    found: dict[str, int] = {}
    for place, one in enumerate(shown):
        found.setdefault(one.entity, place)
    return found
