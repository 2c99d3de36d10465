"""Which faults a reference sees in a recording that is made up, and which it cannot see."""

from __future__ import annotations

from collections import Counter
from typing import Any

import msgspec
import numpy as np
import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.adapters.bag.excerpt import Kept
from roslens.live.adapters.bag.steps import Lane
from roslens.live.adapters.bag.topic import BagTopic
from roslens.live.mutation.fault import Fault, FaultKind
from roslens.live.mutation.score import score
from roslens.live.mutation.trial import LENGTH_S, Trials, margins, planned
from roslens.live.window.signals import BY_KEY
from roslens.model.graph import Graph

SECOND = 1_000_000_000
HZ = {"/scan": 20, "/odom": 50, "/free": 5}
HEAD = "kind: reference\nname: r\ndefaults: {grace: 2 s}\n"


class MadeUp:
    """A recording of 60 s in which topics come as regularly as can be, and a counter is between 0 and 1."""

    messages = 60 * sum(HZ.values())
    start, end = 0.0, 60.0
    topics = tuple(BagTopic(name, "a/msg/A", 60 * hz, "", (), "", False) for name, hz in HZ.items())
    failures = ()

    def traffic(self, stamps: Any) -> Any:
        del stamps
        times = {name: np.arange(0, 60 * SECOND, SECOND // hz, dtype=np.int64) for name, hz in HZ.items()}
        return {Lane(name, ""): (each, np.full(len(each), 100, np.int64), None) for name, each in times.items()}

    def fields(self, wanted: Any) -> Any:
        for number in range(60 * 20 if "/scan" in wanted else 0):
            yield number / 20, "/scan", {"x": number % 7 / 7}

    def graph(self) -> Graph:
        return Graph("ros2")


def trials(text: str) -> Any:
    reference = load_reference([GivenText("r.yaml", (HEAD + text).encode())], BY_KEY)
    kept = Kept(MadeUp(), (), {"/scan": ["x"]})
    tried = Trials(reference, kept.excerpt, margins(reference))
    return lambda kind, topic="/scan": tried.run(Fault(kind, topic, "", 25.0, 30.0), [(topic, "")])


RATE = "constraints: [{topic: /scan, rate: 18..22 Hz}]\n"


def test_a_rate_sees_what_changes_it_and_says_when():
    run = trials(RATE)
    halved = run(FaultKind.RATE_HALVED)
    assert (halved.seen, halved.by, halved.beside) == (True, ("r.topic.scan.rate",), ())
    assert 0 < halved.after_s < 2
    assert run(FaultKind.DEAD_PUBLISHER).seen
    assert not run(FaultKind.WRONG_VALUE).seen
    assert not run(FaultKind.RATE_HALVED, "/odom").seen


def test_a_wide_range_sees_only_what_is_grave():
    run = trials("constraints: [{topic: /scan, rate: '>= 2 Hz'}]\n")
    assert not run(FaultKind.RATE_HALVED).seen
    assert run(FaultKind.DEAD_PUBLISHER).seen


def test_a_check_of_a_field_sees_a_wrong_value():
    run = trials("fields: [{topic: /scan, field: x, range: 0..1}]\n")
    assert run(FaultKind.WRONG_VALUE).by == ("r.field.scan.x.value",)
    assert not run(FaultKind.RATE_HALVED).seen


def test_every_kind_of_every_topic_is_tried_once_before_any_is_tried_twice():
    lanes = {(name, ""): 1 / hz for name, hz in HZ.items()}
    plan = list(planned(lanes, 0.0, 60.0, 12.0, 10.0))
    # Who published is not known here: no node can vanish.
    first = plan[: (len(FaultKind) - 1) * len(lanes)]
    assert set(Counter((one.topic, one.kind) for one in first).values()) == {1}
    assert len(set(plan)) == len(plan)
    assert {one.begin_s for one in plan} == {12.0 + LENGTH_S * n for n in range(7)}
    assert list(planned(lanes, 0.0, 20.0, 12.0, 10.0)) == []


def test_a_node_vanishes_once_and_not_with_each_of_its_topics():
    lanes = {("/a", "/one"): 0.1, ("/b", "/one"): 0.1, ("/c", "/two"): 0.1, ("/d", ""): 0.1}
    plan = planned(lanes, 0.0, 60.0, 12.0, 10.0)
    gone = {(one.topic, one.publisher) for one in plan if one.kind is FaultKind.VANISHED_NODE}
    assert gone == {("/a", "/one"), ("/c", "/two")}


@pytest.mark.parametrize(("period", "length"), [(0.1, 5.0), (3.0, 15.0), (60.0, 38.0)])
def test_a_fault_of_a_slow_topic_lasts_longer_where_there_is_room(period, length):
    plan = list(planned({("/slow", ""): period}, 0.0, 60.0, 12.0, 10.0))
    assert {one.end_s - one.begin_s for one in plan} == {length}
    assert max(one.end_s for one in plan) <= 50.0
    assert min(one.begin_s for one in plan) >= 12.0


def test_the_score_counts_what_was_seen():
    run = trials(RATE)
    found = [run(kind, topic) for kind in FaultKind for topic in HZ]
    result = score(found, (), recording=["a.bag"], references=["r.yaml"], seconds=60.0, planned=99)
    assert result.total.tried == 21
    assert result.total.seen == sum(one.seen for one in found) == sum(cell.seen for cell in result.kinds.values())
    assert result.topics["/odom"]["gap"].seen == 0
    assert "/odom: gap" in result.unseen
    assert result.share == result.total.seen / 21
    assert msgspec.json.decode(msgspec.json.encode(result), type=type(result)) == result


def test_a_recording_that_is_too_large_is_refused():
    class Large(MadeUp):
        messages = 10**9

    with pytest.raises(Exception, match="a recording of 1,000,000,000 messages"):
        Kept(Large(), (), {})
