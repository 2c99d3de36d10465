"""Plays a time line: traffic, samples and graphs by the second, and what the monitor says of them.

A time line is a YAML mapping: ``expect`` (sentences), ``presence``, ``traffic`` (stretches of regular messages),
``samples``, ``graphs``, ``events``, ``calls`` and ``then``: the state that has to hold at an instant.

``senders`` are observers that report periodically: rows that name one as their ``sender`` are reported by it. While one
is ``stopped`` it reports nothing, and afterwards all at once; reports while its line is ``cut`` arrive later, one
frame after the other. While the monitor is ``away``, which has a row of its own, it looks at nothing; afterwards it
takes ``reads`` of what waits with each tick.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import yaml

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import (
    AgeChain,
    Details,
    End,
    Expectation,
    FieldCheck,
    FieldCondition,
    Presence,
    PresenceMode,
    Reference,
    Selector,
    StateCheck,
    StateOf,
    Timing,
)
from roslens.live.join.session import Step
from roslens.live.rate.monitor import Monitor
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Role
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally
from roslens.model.verdict import Verdict

TICK_S = 0.1
_SERIES = ("latency", "age", "processing")
_TIMINGS = {"for": "lasting", "recover": "recovering", "margin": "margin", "grace": "grace", "window": "window"}


def moments(values: list[float]) -> Moments:
    if not values:
        return NOTHING
    return Moments(len(values), sum(values), sum(v * v for v in values), min(values), max(values))


def details(row: dict[str, Any]) -> Details:
    timing = {_TIMINGS[key]: float(row[key]) for key in _TIMINGS if key in row}
    return Details(id=row["id"], severity=Severity(row.get("severity", "warning")), timing=Timing(**timing))


def selector(row: dict[str, Any]) -> Selector:
    fields = {key: row[key] for key in ("name", "host", "type", "publisher", "subscriber") if key in row}
    return Selector(kind=EntityKind(row.get("kind", "topic")), **fields)


def reference(line: dict[str, Any]) -> Reference:
    conditions = lambda row: row and FieldCondition(row["topic"], row["field"], Range.parse(row["range"]))  # noqa: E731
    return Reference(
        name="test",
        expectations=tuple(
            Expectation(
                details(row),
                selector(row),
                row["quantity"],
                Range.parse(row["range"]),
                percentile=row.get("percentile", 0),
            )
            for row in line.get("expect", ())
        ),
        presences=tuple(
            Presence(
                details(row),
                selector(row),
                PresenceMode(row["mode"]),
                selector(row["while"]) if "while" in row else None,
                End(row.get("by", "publisher")),
            )
            for row in line.get("presence", ())
        ),
        field_checks=tuple(
            FieldCheck(
                details(row), row["topic"], row["field"], Range.parse(row["range"]), condition=conditions(row.get("if"))
            )
            for row in line.get("fields", ())
        ),
        states=tuple(
            StateCheck(
                details(row),
                selector(row),
                StateOf(row["of"]),
                tuple(row.get("allowed", ())),
                Range.parse(row["range"]) if "range" in row else None,
                row.get("written", ""),
            )
            for row in line.get("states", ())
        ),
        chains=tuple(
            AgeChain(details(row), tuple(row["topics"]), Range.parse(row["range"])) for row in line.get("chains", ())
        ),
    )


def tallies(row: dict[str, Any]) -> list[tuple[float, Tally]]:
    """Return the tallies of regular traffic, each with when it is delivered."""
    start, end, report = float(row.get("from", 0)), float(row["to"]), float(row.get("report", 0.2))
    period = 1 / row["hz"] if row.get("hz") else float("inf")
    skip = row.get("gaps", ())
    delay, offset = float(row.get("delay", 0)), float(row.get("offset", 0))
    times, at = [], start + period / 2
    while at < end:
        if not any(a <= at < b for a, b in skip):
            times.append(at)
        at += period
    found, last = [], None
    count = round((end - start) / report)
    for step in range(count):
        left, right = start + step * report, start + (step + 1) * report
        mine = [t for t in times if left <= t < right]
        gaps, longest_at = [], 0.0
        for t in mine:
            if last is not None:
                gaps.append(t - last)
                if gaps[-1] == max(gaps):
                    longest_at = last + offset
            last = t
        series = {key: moments([float(row[key])] * len(mine)) for key in _SERIES if key in row}
        tally = Tally(
            row["topic"],
            row.get("publisher", "/p"),
            row.get("subscriber", ""),
            left + offset,
            right + offset,
            len(mine),
            len(mine) * row["size"] if "size" in row else -1,
            mine[0] + offset if mine else 0.0,
            mine[-1] + offset if mine else 0.0,
            moments(gaps),
            series.get("latency", NOTHING),
            series.get("age", NOTHING),
            round(len(mine) * row["lost"] / (100 - row["lost"])) if "lost" in row else -1,
            Observer(row.get("observer", "inside")),
            row.get("host", ""),
            series.get("processing", NOTHING),
            longest_at if row.get("onset", True) else 0.0,
        )
        if mine or row.get("empty", True):
            found.append((right + delay, tally))
    return found


def graph(row: dict[str, Any]) -> Graph:
    ends = [Endpoint(node, Role.PUBLISHER, t) for node, topics in row.get("publish", {}).items() for t in topics]
    ends += [Endpoint(node, Role.SUBSCRIPTION, t) for node, topics in row.get("subscribe", {}).items() for t in topics]
    managed = row.get("lifecycle", {})
    nodes = tuple(
        Node(name, host or "", lifecycle=managed.get(name, "")) for name, host in sorted(row.get("nodes", {}).items())
    )
    types = row.get("types", {})
    ends = [msgspec.structs.replace(end, type=types.get(f"{end.node} {end.name}", "")) for end in ends]
    return Graph(
        "ros2",
        nodes,
        tuple(sorted(ends, key=lambda e: (e.node, e.role.value, e.name))),
        tuple(row.get("hosts", ())),
        parameters=row.get("parameters", {}),
    )


class Sender:
    """An observer of a time line: when what it tells reaches the monitor."""

    def __init__(self, row: dict[str, Any]) -> None:
        self.name = row["name"]
        self.of_graph = row.get("graph", False)
        self.offset = float(row.get("offset", 0))
        self.every = float(row.get("every", 0.2))
        self.cut = row.get("cut", ())
        self.stopped = row.get("stopped", ())
        self.looks = row.get("looks", True)

    def reported(self, at: float) -> float:
        """Return when it tells what it sees at an instant."""
        return next((end for begin, end in self.stopped if begin <= at < end), at)

    def delivered(self, at: float) -> float:
        """Return when what it sees at an instant is delivered."""
        reported = self.reported(at)
        waited = [end + 0.02 * (reported - begin) / self.every for begin, end in self.cut if begin <= reported]
        return max((reported, *waited))

    def frames(self, until: float) -> list[tuple[float, float]]:
        """Return when frames are delivered, each with up to when it has looked on its own clock."""
        times = dict.fromkeys(self.reported(round(n * self.every, 6)) for n in range(1, round(until / self.every) + 1))
        return [(self.delivered(at), at + self.offset if self.looks else 0.0) for at in times]


class Played:
    """What a monitor said along a time line."""

    def __init__(self, line: dict[str, Any]) -> None:
        self.monitor = Monitor(reference(line), start=0.0)
        self.steps: list[Step] = []
        self._events: list[Event] = []
        self._graph: Graph | None = None
        self.changes: list[tuple[float, Verdict]] = []
        self.standing: list[tuple[float, dict[tuple[str, str], Verdict]]] = []
        actions: list[tuple[float, Any]] = []
        senders = {row["name"]: Sender(row) for row in line.get("senders", ())}
        for row in line.get("traffic", ()):
            sender = senders.get(row.get("sender"))
            for at, tally in tallies(row):
                arrives = sender.delivered(at) if sender else at
                actions.append((arrives, lambda t=tally, v=sender: self.monitor.add_tally(t, self._sent_by(v))))
        for sender in senders.values():
            for at, looked in sender.frames(line["until"]):
                actions.append((at, lambda v=sender, t=looked: self._sent_by(v, t)))
        for row in line.get("samples", ()):
            at = float(row.get("from", 0))
            while at < row["to"]:
                sample = Sample(EntityId.parse(row["entity"]), at, {k: float(v) for k, v in row["values"].items()})
                sender = senders.get(row.get("sender"))
                arrives = sender.delivered(at) if sender else at
                actions.append((arrives, lambda s=sample, v=sender: self.monitor.add_sample(s, self._sent_by(v))))
                at += row.get("every", 1.0)
        for row in line.get("graphs", ()):
            actions.append((row["at"], lambda r=row: self._take_graph(graph(r), r["at"])))
        for row in line.get("events", ()):
            event = Event(row["at"], Change(row["change"]), row["entity"])
            actions.append((row["at"], lambda e=event: self._take_event(e)))
        for row in line.get("values", ()):
            values = {key: float(value) for key, value in row["values"].items()}
            actions.append((row["at"], lambda r=row, v=values: self.monitor.add_field(r["topic"], r["at"], v)))
        for row in line.get("calls", ()):
            actions.append((row["at"], lambda r=row: getattr(self.monitor, r["call"])(r["at"])))
        actions.sort(key=lambda action: action[0])
        self._away = line.get("away", {})
        self._run(actions, line.get("clock", []), line["until"])

    def _take_graph(self, whole: Graph, at: float) -> None:
        self._graph = whole
        self.monitor.add_graph(whole, at)

    def _take_event(self, event: Event) -> None:
        self._events.append(event)
        self.monitor.add_event(event)

    def _sent_by(self, sender: Sender | None, looked: float = 0.0) -> Any:
        return sender and self.monitor.take_report(sender.name, looked, of_graph=sender.of_graph)

    def _run(self, actions: list[tuple[float, Any]], clock: list[dict[str, Any]], until: float) -> None:
        """Tick ten times a second; ``clock`` has the stretches in which time stands or from which on it is shifted."""
        place = 0
        for number in range(1, round(until / TICK_S) + 1):
            now = round(number * TICK_S, 6)
            if self._away and self._away["from"] <= now < self._away["to"]:
                continue
            most = place + (self._away["reads"] if self._away and now >= self._away["to"] else len(actions))
            while place < min(len(actions), most) and actions[place][0] <= now + 1e-9:
                actions[place][1]()
                place += 1
            shown = now
            for row in clock:
                if now >= row["at"]:
                    shown = row["at"] if now < row.get("until", 0) else now + row.get("shift", 0)
            verdicts = self.monitor.tick(shown)
            self.changes += [(now, verdict) for verdict in verdicts]
            halted = tuple(sorted(self.monitor.world.halted(shown)))
            self.steps.append(Step(shown, verdicts, tuple(self._events), graph=self._graph, halted=halted))
            self._events, self._graph = [], None
            found = {(str(v.entity), v.expectation): v for v in self.monitor.standing()}
            self.standing.append((now, found))

    def at(self, time: float) -> dict[tuple[str, str], Verdict]:
        return max((row for row in self.standing if row[0] <= time + 1e-9), key=lambda row: row[0])[1]

    def states(self, entity: str, id_: str) -> list[tuple[float, str]]:
        return [(at, v.state.value) for at, v in self.changes if (str(v.entity), v.expectation) == (entity, id_)]


def read(path: Path) -> dict[str, Any]:
    line = yaml.safe_load(path.read_text())
    assert isinstance(line, dict)
    return line


def wrong(line: dict[str, Any], played: Played) -> list[str]:
    """Return what a time line demands and the monitor did not say."""
    found = []
    for row in line["then"]:
        verdict = played.at(row["at"]).get((row["of"], row["id"]))
        for key in ("state", "cause", "leads_to", "severity", "evidence"):
            said = str(getattr(getattr(verdict, key, None), "value", getattr(verdict, key, None)))
            if key in row and said != row[key]:
                found.append(f"at {row['at']}: {row['of']} {row['id']}: {key} is {said}, not {row[key]}: {verdict}")
        for key in ("value", "since"):
            if key in row and (
                verdict is None
                or getattr(verdict, key) is None
                or abs(getattr(verdict, key) - row[key]) > row.get("within", 0.01) * max(abs(row[key]), 1)
            ):
                found.append(f"at {row['at']}: {row['of']} {row['id']}: {key} is not {row[key]}: {verdict}")
    for row in line.get("never", ()):
        found += [
            f"{row['of']} was {state} at {at}"
            for at, state in played.states(row["of"], row["id"])
            if state in row["states"]
        ]
    return found
