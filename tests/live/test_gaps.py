"""Gaps shortly after one another are reported one by one, each from when it began."""

import pytest
from live.time_line import Played

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import Details, Expectation, Reference, Selector
from roslens.live.replay.replay import SHORTEST_STEP_S, STEP_S, usual_step
from roslens.live.window.bucket import Bucket
from roslens.model.entity import EntityKind
from roslens.model.traffic.tally import Moments, Tally

GAPS = [(9.93, 10.14), (11.66, 11.9), (14.05, 14.27), (15.37, 15.58), (16.2, 16.38)]


def line(**traffic):
    return {
        "expect": [
            {"id": "gap", "name": "/imu", "quantity": "largest_gap", "range": "<= 0.16"},
            {"id": "rate", "name": "/imu", "quantity": "rate", "range": "5..300"},
        ],
        "traffic": [{"topic": "/imu", "to": 20, "hz": 200, "gaps": GAPS, **traffic}],
        "until": 20,
    }


def highs(played):
    return [v for _, v in played.changes if v.expectation == "gap" and v.state.value == "high"]


@pytest.mark.parametrize(
    ("traffic", "within"),
    [({"report": 0.1}, 0.01), ({"report": 0.1, "onset": False}, 0.05), ({"report": 0.05, "onset": False}, 0.03)],
)
def test_five_gaps_are_five_alarms(traffic, within):
    reported = highs(Played(line(**traffic)))
    assert [verdict.since for verdict in reported] == [pytest.approx(begun, abs=within) for begun, _ in GAPS]


def test_the_clock_of_the_observer_does_not_matter():
    reported = highs(Played(line(report=0.1, offset=5000.0)))
    assert [verdict.since for verdict in reported] == [pytest.approx(begun, abs=0.01) for begun, _ in GAPS]


def test_tallies_further_apart_still_hold_each_gap_they_tell_of():
    reported = highs(Played(line(report=0.5)))
    assert [verdict.since for verdict in reported][:3] == [pytest.approx(begun, abs=0.01) for begun, _ in GAPS[:3]]


def test_no_gap_is_missed_when_several_tallies_come_at_once():
    played = Played(line(report=0.1, delay=0.0) | {"clock": []})
    late = line(report=0.02)
    assert len(highs(played)) == len(highs(Played(late))) == len(GAPS)


def test_the_greatest_gap_of_two_buckets_keeps_its_beginning():
    def bucket(start, gap, at):
        tally = Tally("/a", "", "", start, start + 1, 5, first=start + 0.1, last=start + 0.9,
                      period=Moments(4, 0.8, 0.2, 0.1, gap), longest_at=at)  # fmt: skip
        return Bucket.of(tally, 0.0)

    early = bucket(1.0, 0.4, 1.2)
    early.absorb(bucket(2.0, 0.3, 2.5))
    assert (early.gap, early.gap_began) == (0.4, 1.2)
    early.absorb(bucket(3.0, 0.5, 3.3))
    assert (early.gap, early.gap_began) == (0.5, 3.3)


@pytest.mark.parametrize(
    ("bounds", "expected"), [((), STEP_S), ((10.0,), STEP_S), ((0.6, 10.0), 0.3), ((0.147,), SHORTEST_STEP_S)]
)
def test_a_recording_is_looked_at_as_often_as_bounds_on_gaps_ask(bounds, expected):
    constraints = [
        Expectation(Details(str(bound)), Selector(EntityKind.TOPIC, "/a"), "largest_gap", Range(None, bound))
        for bound in bounds
    ]
    assert usual_step(Reference("test", expectations=tuple(constraints))) == expected
