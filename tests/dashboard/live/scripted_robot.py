"""A robot that does what a test says, watched by a real session; no clock but the script's."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.cli.page.watch_page import PageSource
from roslens.cli.page.why_page import WhyPage
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.agent.ros_environments import RosEnvironments
from roslens.live.join.session import Session
from roslens.live.past.keeper import in_memory
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Role
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Moments, Observer, Tally
from roslens.model.wire import VERSION, Frame

REFERENCE = """
kind: reference
name: rover
defaults: {grace: 0 s, group: driving}
constraints:
  - {topic: /scan, rate: 8..12 Hz, severity: error, text: Look at the cable of the lidar}
  - {topic: /odom, rate: 45..55 Hz}
  - {topic: /map, rate: ">= 0.5 Hz"}
  - {topic: /cmd_vel, rate: ">= 15 Hz", severity: error, text: The robot stops by itself}
  - {topic: /image, bandwidth: <= 20 MB/s}
  - {node: "/*", cpu: <= 80 %}
  - {host: "*", cpu: <= 95 %}
"""
NODES = {
    **dict.fromkeys(("/lidar", "/camera", "/odometry"), "rover"),
    **dict.fromkeys(("/slam", "/planner", "/ui"), "base"),
}
WIRES = (
    # publisher, topic, subscribers, rate, bytes of a message
    ("/lidar", "/scan", ("/slam", "/planner"), 10, 14_500),
    ("/camera", "/image", ("/ui",), 15, 921_600),
    ("/odometry", "/odom", ("/slam", "/planner"), 50, 720),
    ("/slam", "/map", ("/planner", "/ui"), 1, 160_000),
    ("/planner", "/cmd_vel", ("/odometry",), 20, 48),
    ("/planner", "/planner/status", ("/ui",), 2, 120),
)
OF_ALL = """
kind: reference
name: large
defaults: {grace: 0 s}
constraints:
  - {topic: "/**", rate: ">= 5 Hz"}
"""
Wire = tuple[str, str, tuple[str, ...], int, int]


def written(seconds: float) -> str:
    """Return a time of the script as a clock would show it."""
    return f"12:{int(seconds) // 60:02}:{seconds % 60:04.1f}"


class ScriptedRobot:
    """Runs second by second.

    ``rates`` and ``cpu`` override what is usual, ``gone`` are nodes that are not there. ``sampled`` is what hosts tell
    besides, ``processing`` by topic how many seconds pass from what came into its publisher to what it sends.
    """

    def __init__(
        self, nodes: dict[str, str] | None = None, wires: Iterable[Wire] = WIRES, reference: str = REFERENCE
    ) -> None:
        self.session = Session(load_reference([GivenText("rover.yaml", reference.encode())], BY_KEY), start=0.0)
        self.nodes = dict(NODES if nodes is None else nodes)
        self.wires = list(wires)
        self.rates: dict[str, int] = {}
        self.cpu: dict[str, float] = {}
        self.gone: set[str] = set()
        self.sampled: dict[str, dict[str, float]] = {}
        self.processing: dict[str, float] = {}
        self.now = 0.0
        self._graph: Graph | None = None
        self._asked = 0.0
        self.page = PageSource("rover", clock=written, live=True, steady=self._steady)
        # Whatever else runs on the machine of the test.
        self.page.why = WhyPage(
            lambda: self.page.looked, steady=self._steady, live=True, processes=RosEnvironments, environment={}
        )
        self.keeper = in_memory(self.session)
        self.page.remember(self.keeper.recall())
        self.run(6)

    def _steady(self) -> float:
        self._asked += 10.0
        return self._asked

    def run(self, seconds: int = 1, *, failures: Iterable[Failure] = ()) -> None:
        """Let some seconds pass; a snapshot is made at the end of each."""
        for _ in range(seconds):
            self._second(list(failures))
            failures = ()

    def _second(self, failures: list[Failure]) -> None:
        start, self.now = self.now, self.now + 1.0
        graph = self._graph_now()
        events = [] if self._graph is None else self._changes(self._graph, graph)
        tallies = [tally for wire in self.wires for tally in self._tallies(wire, start)]
        self.session.take(
            [
                Frame(
                    VERSION,
                    "ros2",
                    0,
                    self.now,
                    tallies,
                    list(self._samples()),
                    events,
                    graph if graph != self._graph else None,
                    failures,
                )
            ]
        )
        self._graph = graph
        step = self.session.look(self.now)
        self.page.take(step)
        self.keeper.take(step)
        self.keeper.end()
        self.page.make(self.session, self.now, "0.4 % of a core, 1,234 records")

    def _graph_now(self) -> Graph:
        there = {name: host for name, host in self.nodes.items() if name not in self.gone}
        ends = [Endpoint(wire[0], Role.PUBLISHER, wire[1], "x/msg/X") for wire in self.wires if wire[0] in there]
        ends += [
            Endpoint(name, Role.SUBSCRIPTION, wire[1], "x/msg/X")
            for wire in self.wires
            for name in wire[2]
            if name in there
        ]
        nodes = tuple(Node(name, host, 100 + place) for place, (name, host) in enumerate(sorted(there.items())))
        return Graph("ros2", nodes, tuple(sorted(ends, key=lambda one: (one.name, one.role.value, one.node))))

    def _changes(self, before: Graph, now: Graph) -> list[Event]:
        old, new = ({node.name for node in graph.nodes} for graph in (before, now))
        return [
            Event(self.now, change, f"node:{name}")
            for change, names in ((Change.VANISHED, old - new), (Change.APPEARED, new - old))
            for name in sorted(names)
        ]

    def _samples(self) -> Iterable[Sample]:
        for host in sorted(set(self.nodes.values())):
            values = {"cpu": self.cpu.get(host, 31.0), "memory": 2.1e9, **self.sampled.get(host, {})}
            yield Sample(EntityId(EntityKind.HOST, host), self.now, values)
        for name in self.nodes:
            if name not in self.gone:
                values = {"cpu": self.cpu.get(name, 12.5), "memory": 84e6}
                yield Sample(EntityId(EntityKind.NODE, name), self.now, values)

    def _tallies(self, wire: Wire, start: float) -> Iterable[Tally]:
        publisher, topic, subscribers, usual, size = wire
        rate = self.rates.get(topic, usual)
        if publisher in self.gone:
            return
        gap = 1.0 / rate if rate else 0.0
        period = Moments(rate, 1.0, rate * gap * gap, gap, gap) if rate else Moments()
        first, last = (start + gap / 2, start + 1 - gap / 2) if rate else (0.0, 0.0)
        latency = Moments(rate, rate * 0.0021, rate * 0.0021**2, 0.0021, 0.0021)
        spent = self.processing.get(topic)
        processing = Moments(rate, rate * spent, rate * spent**2, spent, spent) if rate and spent else Moments()
        for subscriber in subscribers:
            if subscriber not in self.gone:
                yield Tally(
                    topic,
                    publisher,
                    subscriber,
                    start,
                    start + 1,
                    rate,
                    rate * size,
                    first,
                    last,
                    period,
                    latency=latency if rate else Moments(),
                    processing=processing,
                    observer=Observer.SCRIPTED,
                )


def large_robot(topics: int) -> ScriptedRobot:
    """Return a robot with so many topics, each from one node to two others."""
    nodes = {f"/part{number // 10}/node{number}": f"host{number % 3}" for number in range(max(topics // 8, 3))}
    names = list(nodes)
    wires: list[Wire] = [
        (
            names[place % len(names)],
            f"/part{place % 10}/topic{place}",
            (names[(place * 7 + 1) % len(names)], names[(place * 3 + 2) % len(names)]),
            10 + place % 5,
            1000,
        )
        for place in range(topics)
    ]
    return ScriptedRobot(nodes, wires, OF_ALL)
