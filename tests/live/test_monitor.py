"""What holds of a monitor whatever comes: order, splits, overload, hostile records, replaced references."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from live.time_line import moments, reference, tallies

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.rate.monitor import Monitor
from roslens.live.system.shown_rows import badge, not_judged
from roslens.live.window.signals import BY_KEY
from roslens.live.window.window import MAX_BUCKETS
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Role
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Moments, Observer, Tally
from roslens.model.verdict import State
from roslens.model.wire import VERSION, Frame

SCAN = {"id": "scan", "name": "/scan", "quantity": "rate", "range": "25..35", "grace": 1}
GAP = {"id": "gap", "name": "/scan", "quantity": "largest_gap", "range": "<= 0.1", "grace": 1}
RULES = reference({"expect": [SCAN, GAP]})


def of_messages(times: list[float], start: float, end: float, last: float | None) -> Tally:
    mine = [time for time in times if start <= time < end]
    before = [time for time in times if time < start]
    series = before[-1:] + mine if last is None else mine
    gaps = [b - a for a, b in pairwise(series)]
    return Tally(
        "/scan", "/p", "", start, end, len(mine), -1, mine[0] if mine else 0.0, mine[-1] if mine else 0.0, moments(gaps)
    )


def judged(tallies_: list[Tally], end: float) -> dict[str, tuple[State, float | None]]:
    monitor = Monitor(RULES, start=0.0)
    for tally in tallies_:
        monitor.add_tally(tally)
    monitor.tick(end)
    return {v.expectation: (v.state, v.value and round(v.value, 6)) for v in monitor.standing()}


class TestMerging:
    @given(st.sets(st.integers(1, 99), max_size=8), st.sampled_from([20.0, 24.9, 30.0, 35.2, 40.0]))
    def test_any_split_of_a_stretch_says_the_same_of_steady_traffic(self, cuts, hertz):
        times = [0.01 + number / hertz for number in range(int(10 * hertz)) if 0.01 + number / hertz < 10]
        edges = [9.0, *(9 + cut / 100 for cut in sorted(cuts)), 10.0]
        early = [of_messages(times, a, a + 0.5, None) for a in [n / 2 for n in range(18)]]
        split = [of_messages(times, a, b, None) for a, b in pairwise(edges)]
        whole = [of_messages(times, 9.0, 10.0, None)]
        first, second = judged(early + split, 10.0), judged(early + whole, 10.0)
        for key, (state, value) in first.items():
            assert state is second[key][0]
            assert value == pytest.approx(second[key][1], rel=1e-4)

    @given(st.permutations(range(6)))
    def test_the_order_of_independent_records_does_not_matter(self, order):
        def traffic(number):
            row = {"topic": "/scan", "publisher": f"/p{number}", "to": 8, "hz": 10 + number}
            return lambda m: [m.add_tally(tally) for _, tally in tallies(row)]

        graph = Graph("ros2", (Node("/p0", "a"),), (Endpoint("/p0", Role.PUBLISHER, "/scan"),))
        records = [
            *map(traffic, range(3)),
            lambda m: m.add_sample(Sample(EntityId(EntityKind.HOST, "a"), 7.0, {"cpu": 95.0})),
            lambda m: m.add_graph(graph, 7.0),
            lambda m: m.add_field("/battery", 7.0, {"volts": 3.0}),
        ]  # fmt: skip
        line = {
            "expect": [SCAN, GAP, {"id": "cpu", "kind": "host", "name": "*", "quantity": "cpu", "range": "<= 80"}],
            "fields": [{"id": "volts", "topic": "/battery", "field": "volts", "range": ">= 11"}],
        }
        said = []
        for numbers in (range(6), order):
            monitor = Monitor(reference(line), start=0.0)
            for number in numbers:
                records[number](monitor)
            monitor.tick(8.0)
            said.append(monitor.standing())
        assert said[0] == said[1]


class TestMisleadingRecords:
    def test_repeated_and_late_tallies_change_nothing(self):
        clean = [tally for _, tally in tallies({"topic": "/scan", "to": 10, "hz": 30})]
        doubled = [tally for one in clean for tally in (one, one)] + clean[-4:]
        swapped = [*clean[:-3], clean[-2], clean[-3], clean[-1]]
        assert judged(doubled, 10.0) == judged(clean, 10.0)
        assert judged(swapped, 10.0)["scan"] == judged(clean, 10.0)["scan"]

    def test_a_window_that_stretches_is_not_counted_twice(self):
        times = [0.01 + number / 30 for number in range(300)]
        stretched = [of_messages(times, 0.0, end / 2, None) for end in range(2, 20)]
        state, value = judged(stretched, 9.5)["scan"]
        assert (state, value) == (State.OK, pytest.approx(30, rel=0.01))

    def test_one_tally_of_the_far_future_does_not_hide_a_silence(self):
        monitor = Monitor(RULES, start=0.0)
        for at, tally in tallies({"topic": "/scan", "to": 10, "hz": 30}):
            monitor.add_tally(tally)
            monitor.tick(at)
        monitor.add_tally(Tally("/scan", "/p", "", 1e9, 1e9 + 1, 30))
        for step in range(101, 120):
            monitor.tick(step / 10)
        assert {v.expectation: v.state for v in monitor.standing()}["scan"] is State.ABSENT

    @pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
    def test_values_that_are_no_numbers_are_unknown(self, bad):
        monitor = Monitor(
            reference({"expect": [{**SCAN, "id": "late", "quantity": "latency", "range": "<= 1"}]}), start=0.0
        )
        for _, tally in tallies({"topic": "/scan", "to": 8, "hz": 30}):
            broken = Moments(tally.count, bad, bad, bad, bad)
            monitor.add_tally(Tally(*(tally.topic, "/p", "", tally.start, tally.end, tally.count), latency=broken))
        monitor.add_tally(Tally("/scan", "/p", "", bad, 8.0, 3))
        monitor.add_sample(Sample(EntityId(EntityKind.HOST, "a"), bad, {"cpu": 1.0}))
        monitor.add_sample(Sample(EntityId(EntityKind.HOST, "a"), 8.0, {"cpu": bad}))
        monitor.add_event(Event(bad, Change.VANISHED, "node:/p"))
        monitor.add_event(Event(1.0, Change.VANISHED, "nonsense"))
        monitor.tick(8.0)
        assert [v.state for v in monitor.standing()] == [State.UNKNOWN]
        assert monitor.refused > 5

    @settings(max_examples=60)
    @given(
        st.lists(
            st.builds(
                Tally,
                topic=st.text(max_size=5),
                publisher=st.text(max_size=3),
                subscriber=st.sampled_from(["", "a > b", "\\", "?"]),
                start=st.floats(),
                end=st.floats(),
                count=st.integers(-5, 2**40),
                bytes=st.integers(-5, 2**60),
                first=st.floats(),
                last=st.floats(),
                period=st.builds(Moments, st.integers(-2, 9), st.floats(), st.floats(), st.floats(), st.floats()),
                lost=st.integers(-5, 2**40),
                observer=st.sampled_from(Observer),
            ),
            max_size=20,
        )
    )
    def test_nonsense_breaks_nothing_and_no_value_is_nonsense(self, records):
        rules = reference(
            {
                "expect": [
                    {"id": q, "name": "**", "quantity": q, "range": ">= 1"}
                    for q in ("rate", "largest_gap", "loss", "bandwidth", "jitter")
                ]
            }
        )
        monitor = Monitor(rules, start=0.0)
        for number, record in enumerate(records):
            monitor.add_tally(record)
            monitor.tick(number / 10)
        for time in (5.0, 10.0, 70.0):
            monitor.tick(time)
        monitor.tree(70.0)
        for verdict in monitor.standing():
            assert verdict.value is None or (math.isfinite(verdict.value) and verdict.value >= 0)


class TestOverload:
    def test_a_hundred_times_the_tallies_neither_grow_nor_lie(self):
        usual = Monitor(RULES, start=0.0)
        flooded = Monitor(RULES, start=0.0)
        for monitor, report in ((usual, 0.5), (flooded, 0.005)):
            for at, tally in tallies({"topic": "/scan", "to": 10, "hz": 30, "report": report}):
                monitor.add_tally(tally)
                if round(at * 1000) % 100 == 0:
                    monitor.tick(at)
        windows = flooded._world.connections["/scan", "/p", ""].alone
        assert len(windows[0].buckets) <= MAX_BUCKETS
        for one, other in zip(usual.standing(), flooded.standing(), strict=True):
            assert one.state is other.state
            assert one.value == pytest.approx(other.value, rel=0.01)

    @pytest.mark.heavy
    def test_ten_thousand_entities_with_hostile_names(self):
        rules = reference({"expect": [{"id": "any", "name": "**", "quantity": "rate", "range": ">= 1"}]})
        monitor = Monitor(rules, start=0.0)
        names = [f"/\N{SNOWMAN}{n}-[::1]/" + "x" * (n % 50) * 20 + " > \\?" for n in range(10_000)]
        for step in range(3):
            for name in names:
                monitor.add_tally(Tally(name, name, name, step * 1.0, step + 1.0, 5, -1, step + 0.1, step + 0.9))
            monitor.tick(step + 1.0)
        monitor.tick(10.0)
        assert len(monitor.standing()) == 10_000
        assert len(monitor.tree(10.0).children[0].children) == 10_000


ALL_KINDS = """\
kind: reference
name: r
defaults: {grace: 0 s, severity: warning}
constraints:
  - {topic: /scan, rate: 30..40 Hz}
  - {node: /gone, expected: always}
fields:
  - {topic: /scan, field: x, range: 1..2}
chains:
  - {topics: [/scan, /map], age: <= 1 s}
"""


def load(name, text):
    return load_reference([GivenText(name, text.encode())], BY_KEY)


class TestReplacedReference:
    def test_what_did_not_change_keeps_its_state_and_what_went_is_told(self):
        monitor = Monitor(RULES, start=0.0)
        for at, tally in tallies({"topic": "/scan", "to": 10, "hz": 20}):
            monitor.add_tally(tally)
            monitor.tick(at)
        before = {v.expectation: (v.state, v.since) for v in monitor.standing()}
        assert before["scan"][0] is State.LOW
        monitor.replace_reference(reference({"expect": [SCAN, {**GAP, "id": "new", "range": "<= 0.01"}]}))
        changed = {v.expectation: v.state for v in monitor.tick(10.1)}
        after = {v.expectation: (v.state, v.since) for v in monitor.standing()}
        assert after["scan"] == before["scan"]
        assert changed == {"gap": State.UNKNOWN, "new": State.HIGH}

    def test_what_is_only_told_otherwise_keeps_its_state_and_is_told_so(self):
        first = load("r.yaml", ALL_KINDS)
        monitor = Monitor(first, start=0.0)
        for at, tally in tallies({"topic": "/scan", "to": 10, "hz": 20}):
            monitor.add_tally(tally)
            monitor.tick(at)
        before = {v.expectation: (v.state, v.since) for v in monitor.standing()}
        assert {key: state for key, (state, _) in before.items()} == {
            "r.topic.scan.rate": State.LOW,
            "r.node.gone.presence": State.ABSENT,
            "r.chain.scan.map.age": State.UNKNOWN,
            "r.field.scan.x.value": State.UNKNOWN,
        }
        monitor.replace_reference(load("r.yaml", "# moved by a line\n" + ALL_KINDS.replace("warning", "error")))
        assert monitor.tick(10.1) == ()
        after = monitor.standing()
        assert {v.expectation: (v.state, v.since) for v in after} == before
        assert {v.where for v in after} == {"r.yaml:6", "r.yaml:7", "r.yaml:9", "r.yaml:11"}
        assert {v.severity for v in after} == {Severity.ERROR}

    def test_a_reference_that_cannot_be_read_leaves_the_old_one(self):
        monitor = Monitor(RULES, start=0.0)
        with pytest.raises(ValueError, match="pattern"):
            monitor.replace_reference(reference({"expect": [{**SCAN, "name": "{a"}]}))
        assert len(monitor.standing()) == 2


class TestTree:
    def test_hosts_hold_nodes_topics_and_connections_and_worst_states_rise_apart_from_their_own(self):
        monitor = Monitor(RULES, start=0.0)
        graph = Graph(
            "ros2", (Node("/laser", "r1"), Node("/slam", "r2")), (Endpoint("/laser", Role.PUBLISHER, "/scan"),)
        )
        monitor.add_graph(graph, 0.0)
        for at, tally in tallies({"topic": "/scan", "publisher": "/laser", "subscriber": "/slam", "to": 10, "hz": 20}):
            monitor.add_tally(tally)
            monitor.tick(at)
        monitor.add_sample(Sample(EntityId(EntityKind.HOST, "r1"), 9.0, {"cpu": 50.0}))
        monitor.tick(10.05)
        tree = monitor.tree(10.05)
        assert (tree.id, tree.state, tree.worst) == ("system", None, State.LOW)
        assert tree.counts == tree.below == {"ok": 1, "low": 1}
        host = next(one for one in tree.children if one.name == "r1")
        assert (host.values, host.observer) == ({"cpu": 50.0}, "agent")
        assert (host.state, host.worst, host.below) == (None, State.LOW, {"ok": 1, "low": 1})
        assert badge(host) == "1 low below"
        topic = host.children[0].children[0]
        assert (topic.id, topic.state, topic.observer) == ("topic:/scan", State.LOW, "inside")
        assert topic.values["rate"] == pytest.approx(20)
        assert (topic.worst, topic.below, badge(topic)) == (State.LOW, {}, "")
        connection = topic.children[0]
        assert (connection.id, connection.state) == ("connection:/laser > /scan > /slam", None)
        other = next(one for one in tree.children if one.name == "r2")
        assert (other.state, other.worst, other.children[0].name) == (None, None, "/slam")
        assert not_judged(tree) == len({"r1", "r2", "/laser", "/slam", connection.id})


class TestDue:
    def test_nothing_is_due_when_only_news_can_change_anything(self):
        monitor = Monitor(reference({"expect": [{**SCAN, "name": "/s*"}]}), start=0.0)
        monitor.tick(0.0)
        assert monitor.next_due(1.0) == math.inf

    def test_silence_and_grace_are_due_in_time(self):
        monitor = Monitor(RULES, start=0.0)
        monitor.tick(0.1)
        due = monitor.next_due(0.1)
        assert 0.1 < due <= 1.0
        monitor.add_tally(Tally("/scan", "/p", "", 0.0, 0.2, 6))
        assert monitor.next_due(0.2) == 0.2

    def test_a_frame_is_everything_in_it(self):
        monitor = Monitor(RULES, start=0.0)
        rows = [tally for _, tally in tallies({"topic": "/scan", "to": 10, "hz": 30})]
        monitor.add_frame(Frame(VERSION, "a/inside", 0, 10.0, rows, shed=7))
        changed = monitor.tick(10.0)
        assert [(v.expectation, v.state) for v in changed] == [("gap", State.OK), ("scan", State.OK)]
        assert changed[1].evidence == "30 messages in 1.0 s, inside, largest gap 0.03 s"
        assert monitor.shed == 7
