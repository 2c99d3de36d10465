"""The rate of a topic is what is sent: who receives much less of it is named beside it, also where it is fine."""

from live.time_line import moments

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.rate.monitor import Monitor
from roslens.live.window.signals import BY_KEY
from roslens.model.traffic.tally import Tally
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
