import math

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import AgeChain, Details, Expectation, FieldCheck, Reference, Selector
from roslens.live.publish.rated import connection_statistics, ranges_of, rated_signals
from roslens.live.system.connection_name import connection_id
from roslens.model.acting.outgoing import ConnectionStatistics, RatedSignal
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.verdict import State, Verdict

SCAN = EntityId(EntityKind.TOPIC, "/scan")
REFERENCE = Reference(
    "r",
    expectations=(Expectation(Details("r.rate"), Selector(EntityKind.TOPIC), "rate", Range(25, 35)),),
    field_checks=(FieldCheck(Details("r.volts"), "/battery", "volts", Range(3)),),
    chains=(AgeChain(Details("r.age"), ("/a", "/b"), Range(maximum=0.2)),),
)


def same(one, other):
    """Compare field by field; NaN equals NaN."""
    pairs = [(getattr(one, name), getattr(other, name)) for name in one.__struct_fields__]
    return all(a == b or (isinstance(a, float) and math.isnan(a) and math.isnan(b)) for a, b in pairs)


def test_every_sentence_with_a_range_has_its_bounds():
    assert ranges_of(REFERENCE) == {"r.rate": Range(25, 35), "r.volts": Range(3), "r.age": Range(maximum=0.2)}


def test_a_verdict_becomes_a_message():
    verdict = Verdict(
        SCAN, "r.rate", "rate", State.LOW, 1.5, 2.0, 12.5, "25..35 Hz", Severity.ERROR, "5 s, 62 messages", "the cable",
        cause="host:base",
    )  # fmt: skip
    (found,) = rated_signals([verdict], ranges_of(REFERENCE))
    assert found == RatedSignal(
        "topic", "/scan", "r.rate", "rate", "Hz", 12.5, 25.0, 35.0, 3, 1.5, 2, "host:base", "5 s, 62 messages",
        "the cable",
    )  # fmt: skip


def test_what_is_not_known_and_bounds_that_are_not_there_are_nan():
    verdict = Verdict(SCAN, "r.presence", "presence", State.ABSENT, 1.0, 2.0)
    (found,) = rated_signals([verdict], ranges_of(REFERENCE))
    nan = math.nan
    assert same(
        found, RatedSignal("topic", "/scan", "r.presence", "presence", "", nan, nan, nan, 5, 1.0, 1, "", "", "")
    )


def test_traffic_of_connections_alone_sorted():
    readings = [
        (SCAN, {"rate": 30.0}),
        (connection_id("/scan", "/b", "/c"), {"rate": 30.0, "loss": 1.0}),
        (connection_id("/scan", "/a", ""), {"latency": 0.1, "cpu": 3.0}),
    ]
    one, other = connection_statistics(readings)
    assert same(one, ConnectionStatistics("/scan", "/a", "", latency=0.1))
    assert same(other, ConnectionStatistics("/scan", "/b", "/c", rate=30.0, drops=1.0))
