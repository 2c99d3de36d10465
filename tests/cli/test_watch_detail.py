"""All that is known of one entity, as the live page shows it when it is chosen."""

from __future__ import annotations

import pytest

from roslens.cli.page.watch_detail import OBSERVED, detail_of
from roslens.live.system.tree import SystemView
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.traffic.tally import Observer
from roslens.model.verdict import Link, State, Verdict

SCAN = EntityId(EntityKind.TOPIC, "/scan")


@pytest.fixture
def whole():
    topic = SystemView(
        "topic:/scan", "/scan", "topic", State.LOW, values={"rate": 4.0, "latency": float("nan")}, observer="inside"
    )
    node = SystemView("node:/lidar", "/lidar", "node", children=(topic,), below={"low": 1})
    host = SystemView("host:base", "base", "host", children=(node,), below={"low": 1})
    return SystemView("system", "system", "system", children=(host,))


def test_the_worst_comes_first_with_value_range_and_since(whole):
    fine = Verdict(SCAN, "r.gap", "largest_gap", State.OK, 1.0, 9.0, 0.1, "<= 1 s")
    low = Verdict(SCAN, "r.rate", "rate", State.LOW, 3.0, 9.0, 4.0, ">= 8 Hz", Severity.ERROR, evidence="4 messages")
    found = detail_of("topic:/scan", whole, [fine, low], " 9 s ", lambda time: f"{time:.0f} s")
    assert found is not None
    assert [(one.title, one.state, one.value, one.expected, one.since) for one in found.judgements] == [
        ("Rate", "low", "4 Hz", ">= 8 Hz", "3 s"),
        ("Largest gap", "ok", "100 ms", "<= 1 s", "1 s"),
    ]
    assert found.observed == "counted inside the node"
    assert [(one.key, one.shown) for one in found.values] == [("rate", "4 Hz")], "what is no number is not shown"


def test_what_is_judged_and_nowhere_in_the_tree_is_told_too(whole):
    gone = Verdict(EntityId(EntityKind.NODE, "/gone"), "r.gone", "presence", State.ABSENT, 3.0, 9.0, 0.0, ">= 1")
    found = detail_of("node:/gone", whole, [gone], "9 s", str)
    assert found is not None
    assert (found.name, found.values, found.judgements[0].title) == ("/gone", (), "presence")
    assert detail_of("node:/nothing", whole, [gone], "9 s", str) is None


def test_what_is_wrong_below_is_told(whole):
    found = detail_of("node:/lidar", whole, [], "9 s", str)
    assert found is not None
    assert (found.below, found.judgements) == ("1 low below", ())


def test_every_way_of_observing_has_words():
    assert OBSERVED.keys() == {one.value for one in Observer}


def test_the_way_to_the_cause_is_told_in_words(whole):
    way = (Link("node:/lidar", "is published by"), Link("host:base", "runs on", "is gone"))
    low = Verdict(SCAN, "r.rate", "rate", State.LOW, 3.0, 9.0, 4.0, cause="host:base", why=way)
    (found,) = detail_of("topic:/scan", whole, [low], " 9 s ", lambda time: f"{time:.0f} s").judgements
    assert found.why == "topic:/scan is published by node:/lidar, which runs on host:base (is gone)"
