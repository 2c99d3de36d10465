"""What a drafted reference is worth: false alarms, and the faults that it reports, on recordings it has not seen.

    python benchmarks/drafts.py [FOLDER] [--half all|tuning|held-out] [--simulated N] [--each] [--alarms]

Each recording is cut in the middle. A reference is drafted from the first half and rates the second. Every alarm counts
as false, whatever really happened, but for two kinds that are counted apart, since they are what the faults below are:
a topic that has ended, on which nothing comes any more up to the end of the recording, and one that really was silent
for a second in the ten before the alarm, though 19 of 20 of its times between messages are below half a second.

Then three faults are put into the second half, on every topic that the draft rates: from a third of it on every other
message is missing; from there on each message is missing with a probability of a third; in its middle nothing comes for
a second, on topics where 19 of 20 times between messages are below half a second. A fault counts as reported where,
after it began, an alarm about its topic is raised that is not there without it. A topic whose alarm stands already when
the fault begins is not counted.

Recordings are distinguished by the hash of their names: those for tuning and those that are held out. Shorter ones than
20 s are left out, and so are those of which nothing can be drafted.
"""

from __future__ import annotations

import argparse
import hashlib
import random
import sys
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.expectation import Reference
from roslens.live.adapters.bag.block import Ints
from roslens.live.adapters.bag.open_bag import open_bag
from roslens.live.adapters.bag.steps import Lane, Steps
from roslens.live.adapters.bag.topic import BagTopic
from roslens.live.drafting.draft import Observed
from roslens.live.drafting.draft_groups import grouped
from roslens.live.drafting.draft_text import draft_text
from roslens.live.replay.alarms import Alarm, AlarmLog
from roslens.live.replay.replay import replay
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.traffic.tally import Tally

SECOND = 1_000_000_000
TYPE = "std_msgs/msg/String"
SHORTEST_S = 20.0
SILENCE_S = 1.0
RECENT_S = 10.0
FASTEST_S = 0.5
"""A topic on which one message in twenty comes later than that is not asked for a silence of a second."""
HELD_OUT = 3000
"""Number of the first robot that nothing was tuned to."""
LEAST_LEFT = 10
"""Messages that a fault which lasts must have to spoil."""

Arrivals = Mapping[tuple[str, str], Ints]
"""When messages came, in ns, by topic and publisher."""


class Traffic(NamedTuple):
    """Everything that came while somebody recorded; times in ns."""

    name: str
    topics: tuple[BagTopic, ...]
    graph: Graph
    arrivals: Arrivals
    start: int
    end: int


class Stretch:
    """A part of a recording that can be replayed as if it were one."""

    failures: tuple[Failure, ...] = ()
    graphs: tuple[tuple[float, Graph], ...] = ()

    def __init__(self, traffic: Traffic, start: int, end: int, arrivals: Arrivals | None = None) -> None:
        self.topics = traffic.topics
        self.start, self.end = start / SECOND, end / SECOND
        self._bounds = start, end
        self._arrivals = traffic.arrivals if arrivals is None else arrivals
        self._graph = traffic.graph

    def graph(self) -> Graph:
        """Return the graph of the whole recording."""
        return self._graph

    def tallies(self, step: float = 1.0, stamps: Collection[str] = ()) -> Iterator[tuple[float, list[Tally]]]:
        """Yield the traffic step by step."""
        del stamps
        start, end = self._bounds
        lanes = {key: Lane(*key) for key in sorted(self._arrivals)}
        steps = Steps(start, round(step * SECOND), set(lanes.values()))
        for key, times in self._arrivals.items():
            inside = times[(times >= start) & (times <= end)]
            steps.add(lanes[key], inside, np.full(len(inside), 8), None)
        yield from steps.rest(end)

    def fields(self, wanted: Mapping[str, Collection[str]]) -> Iterator[tuple[float, str, dict[str, float]]]:
        """Yield nothing: drafts say nothing of fields."""
        del wanted
        return iter(())


class Outcome(NamedTuple):
    """What one recording gave; ``ended`` and ``silent`` are alarms that are right."""

    name: str
    hours: float
    topics: int
    rated: int
    alarms: list[Alarm]
    ended: list[Alarm]
    silent: list[Alarm]
    asked: Counter[str]
    reported: Counter[str]
    missed: list[str]


def halved(times: Ints, begin: int, rng: random.Random) -> Ints:
    """Leave out every other message from ``begin`` on."""
    del rng
    at = int(np.searchsorted(times, begin))
    return np.concatenate([times[:at], times[at::2]])


def third_lost(times: Ints, begin: int, rng: random.Random) -> Ints:
    """Leave out each message from ``begin`` on with a probability of a third."""
    kept: Ints = np.array([time < begin or rng.random() >= 1 / 3 for time in times.tolist()], dtype=bool)
    return times[kept]


def silence(times: Ints, begin: int, rng: random.Random) -> Ints:
    """Leave out what came in the second from ``begin`` on."""
    del rng
    return times[(times < begin) | (times >= begin + SILENCE_S * SECOND)]


FAULTS: dict[str, tuple[Callable[[Ints, int, random.Random], Ints], float]] = {
    "halved rate": (halved, 1 / 3),
    "a third lost": (third_lost, 1 / 3),
    "1 s of silence": (silence, 1 / 2),
}
"""What makes a fault, and where in the half it begins."""


def alarms_of(reference: Reference, stretch: Stretch) -> list[Alarm]:
    """Return what a reference raises on a part of a recording."""
    log = AlarmLog()
    replay(stretch, reference, report=lambda step: log.add(step.changes))
    return list(log.alarms())


def traffic_of(path: Path) -> Traffic:
    """Return what a recording holds."""
    bag = open_bag(path)
    start, end = round(bag.start * SECOND), round(bag.end * SECOND)
    return Traffic(path.name, bag.topics, bag.graph(), bag.arrivals(), start, end)


def measured(traffic: Traffic, *, each: bool) -> Outcome | None:
    """Measure one recording; None where it is too short or holds too little."""
    start, end = traffic.start, traffic.end
    if end - start < SHORTEST_S * SECOND:
        return None
    middle = (start + end) // 2
    observed = Observed()
    observed.add_types((topic.name, topic.type) for topic in traffic.topics)
    for _, tallies in Stretch(traffic, start, middle).tallies(observed.step_s):
        observed.add(tallies)
    drafts = observed.drafted() if each else grouped(observed.drafted())
    if not drafts:
        return None
    text = draft_text("draft", drafts, observed.left_out(), traffic.name)
    reference = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY)
    rated = {name for one in drafts if one.rated for name in one.names}
    plain = alarms_of(reference, Stretch(traffic, middle, end))
    asked: Counter[str] = Counter()
    reported: Counter[str] = Counter()
    missed = []
    for fault, (broken, share) in FAULTS.items():
        begin = middle + round((end - middle) * share)
        spoilt = {
            key: broken(times, begin, random.Random(f"{traffic.name}{key}")) if key[0] in rated else times
            for key, times in traffic.arrivals.items()
        }
        found = alarms_of(reference, Stretch(traffic, middle, end, spoilt))
        standing = {_topic(one) for one in plain if one.reported <= begin / SECOND <= one.until}
        known = {(one.first.expectation, _topic(one), round(one.reported, 3)) for one in plain}
        for topic in sorted(rated - standing):
            if not _speaks(traffic.arrivals, topic, begin, fault):
                continue
            new = any(
                _topic(one) == topic
                and one.reported >= begin / SECOND
                and (one.first.expectation, topic, round(one.reported, 3)) not in known
                for one in found
            )
            asked[fault] += 1
            reported[fault] += new
            missed += [] if new else [f"{fault}: {topic}"]
    ended = [one for one in plain if _ended(traffic, one)]
    silent = [one for one in plain if one not in ended and _silent(traffic, one)]
    false = [one for one in plain if one not in ended and one not in silent]
    hours = (end - middle) / SECOND / 3600
    topics = len({name for name, _ in traffic.arrivals})
    return Outcome(traffic.name, hours, topics, len(rated), false, ended, silent, asked, reported, missed)


def _topic(alarm: Alarm) -> str:
    return alarm.first.entity.name if alarm.first.entity.kind is EntityKind.TOPIC else ""


def _ended(traffic: Traffic, alarm: Alarm) -> bool:
    """Whether an alarm is about a topic on which nothing comes any more, up to the end of the recording."""
    last = int(max(_of_topic(traffic.arrivals, _topic(alarm)), default=0))
    return alarm.until == float("inf") and last < traffic.end - SILENCE_S * SECOND and alarm.reported > last / SECOND


def _silent(traffic: Traffic, alarm: Alarm) -> bool:
    """Whether an alarm is about a topic that fell silent for as long as the fault that is put in."""
    times = _of_topic(traffic.arrivals, _topic(alarm))
    gaps = np.diff(times)
    recent = (times[1:] <= alarm.reported * SECOND + SECOND) & (times[1:] >= (alarm.reported - RECENT_S) * SECOND)
    usual = len(gaps) and float(np.percentile(gaps, 95)) <= FASTEST_S * SECOND
    return bool(usual and (gaps[recent] >= SILENCE_S * SECOND).any())


def _of_topic(arrivals: Arrivals, topic: str) -> Ints:
    return np.sort(
        np.concatenate([np.zeros(0, np.int64), *(one for (name, _), one in arrivals.items() if name == topic)])
    )


def _speaks(arrivals: Arrivals, topic: str, begin: int, fault: str) -> bool:
    """Whether something is there that the fault could take away."""
    times = _of_topic(arrivals, topic)
    if fault == "1 s of silence":
        around = times[(times >= begin - 3 * SECOND) & (times <= begin + 4 * SECOND)]
        return len(around) > 1 and float(np.percentile(np.diff(around), 95)) <= FASTEST_S * SECOND
    return int((times >= begin).sum()) >= LEAST_LEFT


def half_of(name: str) -> str:
    """Return whether a recording is for tuning or held out."""
    return ("tuning", "held-out")[hashlib.sha256(name.encode()).digest()[0] % 2]


def robot(number: int) -> Traffic:
    """Return twenty minutes of a robot that is made up: sensors with jitter, losses, hiccups and bursts, and events."""
    rng = np.random.default_rng(number)
    end = 1200 * SECOND
    hiccups = np.sort(rng.uniform(0, 1200, rng.poisson(4)))
    arrivals: dict[tuple[str, str], Ints] = {}
    for place, hertz in enumerate(rng.choice([0.2, 1, 2, 5, 10, 15, 20, 30, 50, 100], 8)):
        times = np.arange(rng.uniform(0, 1 / hertz), 1200, 1 / hertz)
        times = np.sort(times + rng.normal(0, rng.choice([0.01, 0.05, 0.3]) / hertz, len(times)))
        times = times[rng.random(len(times)) >= rng.choice([0, 0.01, 0.05])]
        for begin in hiccups:
            # What waits in a queue comes at once, the rest is lost.
            length = rng.uniform(0.1, 0.8)
            held = (times >= begin) & (times < begin + length)
            times[held] = begin + length
            times = times[~held | (rng.random(len(times)) < rng.choice([0, 1]))]
        arrivals[f"/sensor_{place}", "/driver"] = _ns(times)
    starts = rng.uniform(0, 1200, 30)
    arrivals["/cmd_vel", "/teleop"] = _ns(
        np.concatenate([np.arange(at, at + rng.exponential(8), 0.1) for at in starts])
    )
    arrivals["/event", "/planner"] = _ns(rng.uniform(0, 1200, 200))
    arrivals["/walk", "/planner"] = _ns(np.cumsum(rng.lognormal(-1, 1, 2000)))
    kept = {key: times[(times > 0) & (times < end)] for key, times in arrivals.items()}
    topics = tuple(BagTopic(name, TYPE, len(times)) for (name, _), times in sorted(kept.items()))
    graph = Graph("ros1", (), tuple(Endpoint(node, Role.PUBLISHER, name, TYPE) for name, node in sorted(kept)))
    return Traffic(f"robot {number}", topics, graph, kept, 0, end)


def _ns(seconds: np.ndarray[tuple[int], np.dtype[np.float64]]) -> Ints:
    return np.sort((seconds * SECOND).astype(np.int64))


def total(outcomes: Sequence[Outcome]) -> str:
    """Return the last row of the table."""
    hours, alarms = sum(one.hours for one in outcomes), sum(len(one.alarms) for one in outcomes)
    cells = [
        f"all {len(outcomes)}",
        f"{hours:.3f}",
        str(sum(one.topics for one in outcomes)),
        str(sum(one.rated for one in outcomes)),
        f"{alarms} ({alarms / max(hours, 1e-9):.1f} an hour)",
        str(sum(len(one.ended) for one in outcomes)),
        str(sum(len(one.silent) for one in outcomes)),
    ]
    for fault in FAULTS:
        asked, reported = sum(one.asked[fault] for one in outcomes), sum(one.reported[fault] for one in outcomes)
        cells.append(f"{reported} of {asked} ({100 * reported / max(asked, 1):.1f} %)")
    return f"| {' | '.join(cells)} |"


def rows(outcomes: Sequence[Outcome], shown: Sequence[str]) -> Iterator[str]:
    """Yield the table, with a row for each recording."""
    head = ["recording", "hours", "topics", "rated", "false alarms", "ended", "silent", *FAULTS]
    yield f"| {' | '.join(head)} |"
    yield f"| {' | '.join('---' for _ in head)} |"
    for one, name in zip(outcomes, shown, strict=True):
        cells = [
            name,
            f"{one.hours:.4f}",
            str(one.topics),
            str(one.rated),
            *(str(len(kind)) for kind in (one.alarms, one.ended, one.silent)),
        ]
        cells += [f"{one.reported[fault]} of {one.asked[fault]}" for fault in FAULTS]
        yield f"| {' | '.join(cells)} |"
    yield total(outcomes)


def main() -> int:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("folder", type=Path, nargs="?", help="recordings")
    arguments.add_argument("--half", choices=["all", "tuning", "held-out"], default="all")
    arguments.add_argument("--simulated", type=int, default=0, metavar="N", help="N robots that are made up, besides")
    arguments.add_argument("--each", action="store_true", help="no joining of topics that are alike")
    arguments.add_argument("--alarms", action="store_true", help="list the alarms, and what was not reported")
    options = arguments.parse_args()
    found = sorted(options.folder.iterdir()) if options.folder else []
    paths = [path for path in found if path.suffix in {".bag", ".mcap", ".db3"}]
    names = [path.name for path in paths if options.half in ("all", half_of(path.name))]
    traffics = [traffic_of(options.folder / name) for name in names]
    first = HELD_OUT if options.half == "held-out" else 0
    traffics += [robot(first + number) for number in range(options.simulated)]
    outcomes = [one for traffic in traffics if (one := measured(traffic, each=options.each)) is not None]
    print("\n".join(rows(outcomes, [one.name for one in outcomes])))
    if options.alarms:
        for one in outcomes:
            kinds = (("false", one.alarms), ("ended", one.ended), ("silent", one.silent))
            for word, alarm in ((word, alarm) for word, alarms in kinds for alarm in alarms):
                what = alarm.worst
                print(f"{one.name}: {word}: {what.entity} {what.quantity} {what.value or 0:.3g}, not {what.range}")
            for missed in one.missed:
                print(f"{one.name}: not reported: {missed}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
