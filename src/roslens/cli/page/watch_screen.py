"""What `roslens watch` shows on a terminal: the tree with its worst states, what is wrong, what it costs."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence

from roslens.judge.ranges.amount import amount_text
from roslens.live.publish.diagnostics import verdict_message
from roslens.live.reported.reported_levels import is_reported
from roslens.live.system.connection_name import connection_ends
from roslens.live.system.shown_rows import badge, is_shown, not_judged
from roslens.live.system.tree import SystemView
from roslens.live.window.signals import BY_KEY, RECEIVED
from roslens.model.entity import EntityId
from roslens.model.graph import Event
from roslens.model.verdict import State, Verdict
from roslens.report.writing.terminal import Terminal, columns, left, right

COLUMNS = {
    "rate": "rate", RECEIVED: "received", "largest_gap": "gap", "latency": "latency", "cpu": "cpu", "memory": "memory",
    "bandwidth": "bandwidth", "loss": "loss", "calls": "calls", "response_time": "answer in",
}  # fmt: skip
"""The values of a row and their headings, the first ones for narrow terminals too."""
_AS_SENT = 0.9
"""A topic of which less is received than this share of what is sent says so on narrow terminals too."""
_CELL = 11
_LEAST_NAME = 24
_STATE = 12
NOT_JUDGED = "not judged"
"""In place of a state, of what no constraint judges."""
_MOST_ALERTS = 8

GLYPHS: Mapping[State | None, tuple[str, str, str]] = {
    None: ("\N{EN DASH}", "-", "quiet"),
    State.OK: ("✔", "+", "fine"),
    State.SUSPENDED: ("‖", "=", "quiet"),
    State.UNKNOWN: ("?", "?", "quiet"),
    State.LOW: ("▼", "v", "warning"),
    State.HIGH: ("▲", "^", "warning"),
    State.ABSENT: ("✖", "x", "error"),
}
"""Sign, plain sign and role of colour of each state, and of what nothing judges."""


def state_text(terminal: Terminal, state: State | None) -> str:
    """Return sign and word of a state, in its colour; ``not judged`` of None."""
    sign, plain, role = GLYPHS[state]
    word = NOT_JUDGED if state is None else state.value
    return terminal.paint(f"{sign if terminal.unicode else plain} {word:<10}", role)


def value_text(key: str, value: float) -> str:
    """Return a value as people read it: three digits and a unit."""
    signal = BY_KEY[key]
    shown = amount_text(float(f"{value:.3g}"), signal.unit)
    number = shown.partition(" ")[0]
    return f"{value:,.0f} {signal.unit}".rstrip() if "e" in number else shown


def screen(
    terminal: Terminal,
    view: SystemView,
    verdicts: Sequence[Verdict],
    *,
    title: str,
    height: int,
    clock: Callable[[float], str],
    notes: Iterable[str] = (),
) -> list[str]:
    """Return the lines of the whole screen, none wider than the terminal and at most ``height`` of them.

    Args:
        terminal: what can be shown.
        view: the system.
        verdicts: that stand.
        title: what is watched.
        height: lines there are.
        clock: how a time is written.
        notes: further lines for the bottom, such as what could not be observed.
    """
    head = [_first_line(terminal, view, title)]
    bottom = _alerts(terminal, verdicts, clock)
    bottom += [terminal.paint(terminal.cut(terminal.clean(note), terminal.width), "warning") for note in notes]
    room = max(height - len(head) - len(bottom) - 2, 3)
    return [*head, *_table(terminal, view, room), *bottom][:height]


def _first_line(terminal: Terminal, view: SystemView, title: str) -> str:
    counts = [f"{count} {state}" for state, count in view.counts.items() if count] or ["nothing is judged yet"]
    counts += [f"{parts:,} {NOT_JUDGED}"] if (parts := not_judged(view)) and view.counts else []
    return terminal.cut(f"{terminal.clean(title)}   {', '.join(counts)}", terminal.width)


def _table(terminal: Terminal, view: SystemView, room: int) -> list[str]:
    rows = list(_rows(view.children, 0))
    shown = [key for key in COLUMNS if any(key in row.values for _, row in rows)]
    longest = max((columns(_name(row, terminal)) + 2 * depth + 1 for depth, row in rows), default=0)
    least = max(_LEAST_NAME, min(longest, terminal.width // 2 - _STATE))
    dispensable = RECEIVED in shown and not any(_is_lost(row) for _, row in rows)
    while shown and terminal.width - _STATE - 1 - _CELL * len(shown) < least:
        shown.pop(shown.index(RECEIVED) if dispensable else -1)
        dispensable = False
    width = terminal.width - _STATE - 1 - _CELL * len(shown)
    lines = [
        terminal.paint(
            " " * (_STATE + 1) + left("", width) + "".join(right(COLUMNS[key], _CELL) for key in shown), "quiet"
        )
    ]
    chosen = rows if len(rows) <= room else _worst(rows, room - 1)
    for depth, row in chosen:
        remark = f"  ({said})" if (said := badge(row)) else ""
        name = terminal.cut("  " * depth + terminal.clean(_name(row, terminal) + remark), width - 1)
        cells = "".join(right(_cell(row, key), _CELL) for key in shown)
        lines.append(f"{state_text(terminal, row.state)} {left(name, width)}{cells}".rstrip())
    if len(chosen) < len(rows):
        more = len(rows) - len(chosen)
        lines.append(terminal.paint(f"{' ' * (_STATE + 1)}{more} more that are fine or no worse", "quiet"))
    return lines


def _is_lost(row: SystemView) -> bool:
    """Whether somebody receives much less than is sent on a topic."""
    sent = row.values.get("rate")
    return sent is not None and row.values.get(RECEIVED, sent) < _AS_SENT * sent


def _rows(parts: Iterable[SystemView], depth: int) -> Iterable[tuple[int, SystemView]]:
    for part in parts:
        if not is_shown(part):
            continue
        yield depth, part
        yield from _rows(part.children, depth + 1)


def _worst(rows: Sequence[tuple[int, SystemView]], room: int) -> list[tuple[int, SystemView]]:
    order: dict[State | None, int] = {state: place for place, state in enumerate((None, *State))}
    ranked = sorted(range(len(rows)), key=lambda at: (-order[rows[at][1].worst], rows[at][0], at))
    return [rows[at] for at in sorted(ranked[:room])]


def _name(row: SystemView, terminal: Terminal) -> str:
    if row.kind == "connection":
        _, _, subscriber = connection_ends(EntityId.parse(row.id))
        return f"{'→' if terminal.unicode else '->'} {subscriber or '?'}"
    if row.name:
        return row.name
    return nameless(row)


def nameless(part: SystemView) -> str:
    """Return what stands for a part of which nobody knows the name, by what is below it."""
    if part.kind == "host":
        # What does not run is on no host.
        gone = all(child.state is State.ABSENT for child in part.children if child.name)
        return "(not running)" if gone and any(child.name for child in part.children) else "(host unknown)"
    kinds = {child.kind for child in part.children}
    if "service" not in kinds:
        return "(publisher unknown)"
    return "(server unknown)" if kinds == {"service"} else "(publisher or server unknown)"


def _cell(row: SystemView, key: str) -> str:
    return value_text(key, row.values[key]) if key in row.values else ""


def urgency(one: Verdict) -> tuple[bool, int, float, EntityId, str]:
    """Return by what alerts are sorted: who is not heard, then the gravest, of these the one that began first."""
    return not one.of_observer, -one.severity.rank, one.since, one.entity, one.expectation


def _alerts(terminal: Terminal, verdicts: Sequence[Verdict], clock: Callable[[float], str]) -> list[str]:
    silent = {str(one.entity) for one in verdicts if one.of_observer}
    bad = [one for one in verdicts if one.wrong or one.cause in silent]
    causes = sorted((one for one in bad if not one.cause), key=urgency)
    lines = [""] if bad else []
    lines += [alert_line(terminal, one, clock(one.since)) for one in causes[:_MOST_ALERTS]]
    left_out = len(causes) - _MOST_ALERTS
    if left_out > 0:
        lines.append(terminal.paint(f"{' ' * (_STATE + 1)}{left_out} more", "quiet"))
    if len(bad) > len(causes):
        lines.append(
            terminal.paint(f"{' ' * (_STATE + 1)}and {len(bad) - len(causes)} that follow from these", "quiet")
        )
    return lines


def alert_line(terminal: Terminal, verdict: Verdict, when: str, lasted: float | None = None) -> str:
    """Return one verdict on one line: when, how it stands, what, why; and how many seconds what is over had lasted."""
    says = verdict.state.bad or verdict.of_observer
    text = terminal.clean(f"{verdict.entity}  {verdict_message(verdict)}" if says else f"{verdict.entity}")
    if not says:
        text += terminal.clean(f"  {verdict.quantity} {_value(verdict)}")
    if lasted is not None:
        text += f"  again, after {lasted:.1f} s"
    room = terminal.width - columns(when) - _STATE - 3
    return f"{when} {state_text(terminal, verdict.state)}  {terminal.cut(text, max(room, 20))}"


def event_text(terminal: Terminal, event: Event, when: str) -> str:
    """Return on one line what happened to a part of the system."""
    said = event.detail if is_reported(event) else f"{event.change.value} {event.detail}".strip()
    room = terminal.width - columns(when) - _STATE - 3
    return f"{when} {'':{_STATE + 2}}{terminal.cut(terminal.clean(f'{event.entity}  {said}'), max(room, 20))}"


def cause_text(terminal: Terminal, verdict: Verdict, when: str) -> str:
    """Return on one line what a fault that goes on is explained by from now on."""
    why = f"now because of {verdict.cause}" if verdict.cause else "now by itself, because of nothing else"
    quantity = BY_KEY[verdict.quantity].title.lower() if verdict.quantity in BY_KEY else verdict.quantity
    text = terminal.clean(f"{verdict.entity}  {quantity} is still {verdict.state.value}, {why}")
    room = terminal.width - columns(when) - _STATE - 3
    return f"{when} {state_text(terminal, verdict.state)}  {terminal.cut(text, max(room, 20))}"


def _value(verdict: Verdict) -> str:
    if verdict.value is None or verdict.quantity not in BY_KEY:
        return ""
    return f"is {value_text(verdict.quantity, verdict.value)}"


def time_of_day(seconds: float) -> str:
    """Return a time of the wall clock: ``12:03:59.5``."""
    return time.strftime("%H:%M:%S", time.localtime(seconds)) + f".{int(seconds * 10) % 10}"


def since_start(start: float) -> Callable[[float], str]:
    """Return what writes a time as seconds since the start of a recording."""
    return lambda seconds: f"{seconds - start:+9.2f} s"
