"""The rate of a topic is what is sent: who receives much less of it is named beside it, also where it is fine."""

import msgspec
import pytest
from live.time_line import moments

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.rate.monitor import Monitor
from roslens.live.window.signals import BY_KEY
from roslens.model.traffic.tally import Observer, Tally
from roslens.model.verdict import State

TEXT = b"kind: reference\nname: r\nconstraints:\n  - {topic: /big, rate: 8..12 Hz}\n"
RULES = load_reference([GivenText("r.yaml", TEXT)], BY_KEY)


def received(subscriber, second, count):
    gaps = [1.0 / count] * count
    return Tally(
        "/big", "/camera", subscriber, float(second), second + 1.0, count, -1, second + 0.001, second + 0.999,
        moments(gaps),
    )  # fmt: skip


def evidence(**rates):
    monitor = Monitor(RULES, start=0.0)
    for second in range(30):
        for subscriber, count in rates.items():
            monitor.add_tally(received(f"/{subscriber}", second, count))
        monitor.tick(second + 1.0)
    (verdict,) = monitor.standing()
    assert verdict.state is State.OK
    return verdict.evidence


def test_who_receives_much_less_than_is_sent_is_named():
    assert evidence(fast=10, slow=1).endswith("; sent at this rate, received at 1 Hz by /slow")


def test_what_arrives_as_it_is_sent_needs_no_remark():
    assert "received" not in evidence(fast=10, other=10)
    assert "received" not in evidence(fast=10)


BY_RECEIPT = load_reference([GivenText("r.yaml", TEXT.replace(b"rate:", b"rate_received:"))], BY_KEY)


def watched(rules, *, seconds=30, **rates):
    monitor = Monitor(rules, start=0.0)
    for second in range(seconds):
        for subscriber, count in rates.items():
            monitor.add_tally(received(f"/{subscriber}", second, count))
        monitor.tick(second + 1.0)
    return monitor


def values_of(monitor, topic):
    waiting = [monitor.tree(30.0)]
    while waiting:
        part = waiting.pop()
        if part.id == topic:
            return part.values
        waiting += part.children
    raise AssertionError(topic)


def test_what_is_sent_and_what_the_slowest_subscriber_receives_are_both_values_of_a_topic():
    values = values_of(watched(RULES, fast=10, slow=4), "topic:/big")
    assert (round(values["rate"], 3), round(values["rate_received"], 3)) == (10.0, 4.0)


@pytest.mark.parametrize(("slow", "state"), [(10, State.OK), (4, State.LOW)])
def test_what_is_received_is_judged_apart_from_what_is_sent(slow, state):
    (verdict,) = watched(BY_RECEIPT, fast=10, slow=slow).standing()
    assert (verdict.quantity, verdict.state) == ("rate_received", state)


def test_where_nobody_is_seen_to_receive_it_is_not_known():
    monitor = Monitor(BY_RECEIPT, start=0.0)
    for second in range(30):
        monitor.add_tally(msgspec.structs.replace(received("", second, 10), subscriber=""))
        monitor.tick(second + 1.0)
    (verdict,) = monitor.standing()
    assert verdict.state is State.UNKNOWN
    assert "rate_received" not in values_of(monitor, "topic:/big")


def test_a_subscriber_gets_the_messages_of_all_publishers():
    monitor = Monitor(RULES, start=0.0)
    for second in range(30):
        for publisher in ("/one", "/other"):
            monitor.add_tally(msgspec.structs.replace(received("/slow", second, 5), publisher=publisher))
        monitor.tick(second + 1.0)
    values = values_of(monitor, "topic:/big")
    assert (round(values["rate"], 3), round(values["rate_received"], 3)) == (10.0, 10.0)


def test_what_the_counters_of_a_publisher_say_is_its_rate_where_a_subscriber_is_slow():
    """ROS 1: what is received is counted in the node, what is sent is told by it where nobody gets all of it."""
    monitor = Monitor(RULES, start=0.0)
    for second in range(30):
        if not second % 2:
            monitor.add_tally(msgspec.structs.replace(received("/slow", second, 1), end=second + 2.0))
        sent = Tally("/big", "/camera", "", float(second), second + 1.0, 10, observer=Observer.PROTOCOL)
        monitor.add_tally(sent)
        monitor.tick(second + 1.0)
    (verdict,) = monitor.standing()
    assert (verdict.state, verdict.value) == (State.OK, 10.0)
    assert "; sent at this rate, received at" in verdict.evidence
