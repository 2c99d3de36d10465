from roslens.model.finding import Severity
from roslens.model.qos import Qos
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.timing.queue import found
from testbed.configured import SENSOR, configuration, end, node, timer

ONE = Qos("best_effort", "volatile", "keep_last", 1)
SLOW_READER = node("/b", end("sub", "/x", qos=ONE))


def findings(*nodes, **surroundings):
    return list(found(configuration(*nodes), Surroundings(**surroundings)))


def test_a_fast_timer_and_a_queue_of_one_are_a_note():
    (one,) = findings(node("/a", end("pub", "/x", qos=SENSOR), timers=(timer(0.01),)), SLOW_READER)
    assert one.severity is Severity.NOTE
    assert (
        "/b (src/b.cpp:1) keeps 1 message of /x, which /a (src/a.cpp:1) publishes best effort with 100 Hz"
        in one.message
    )


def test_a_slow_or_unknown_rate_and_a_longer_queue_are_none():
    assert not findings(node("/a", end("pub", "/x", qos=SENSOR), timers=(timer(1.0),)), SLOW_READER)
    assert not findings(node("/a", end("pub", "/x", qos=SENSOR), timers=(timer(None),)), SLOW_READER)
    assert not findings(node("/a", end("pub", "/x", qos=SENSOR)), SLOW_READER)
    fast = node("/a", end("pub", "/x", qos=SENSOR), timers=(timer(0.01),))
    assert not findings(fast, node("/b", end("sub", "/x", qos=SENSOR)))
    assert not findings(fast, SLOW_READER, fast_hz=200.0)


def test_a_node_that_others_move_has_no_rate_that_is_known():
    assert not findings(node("/a", end("pub", "/x"), end("sub", "/y"), timers=(timer(0.01),)), SLOW_READER)
