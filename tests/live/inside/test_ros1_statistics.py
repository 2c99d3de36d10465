import types

import pytest

from roslens.live.inside import ros1_statistics
from roslens.live.inside.ros1_statistics import LightLogger, hook_topics


class Stamp:
    def __init__(self, seconds):
        self.secs, self.nsecs = int(seconds), round((seconds % 1) * 1e9)


class Message:
    def __init__(self, sequence=None, stamp=0.0):
        self._has_header = sequence is not None
        self.header = types.SimpleNamespace(seq=sequence, stamp=Stamp(stamp))


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    teller = types.SimpleNamespace(clock=lambda: now[0], loggers=set())
    teller.add, teller.discard = teller.loggers.add, teller.loggers.discard
    monkeypatch.setattr(ros1_statistics, "_TELLER", teller)
    return now


def subscriber(name="/scan", publishers=("/lidar",)):
    return types.SimpleNamespace(name=name, connections=[types.SimpleNamespace(callerid_pub=p) for p in publishers])


def test_what_came_is_told_once_and_silence_too(clock):
    logger = LightLogger(subscriber())
    for number in range(5):
        clock[0] = 100.0 + number
        logger.callback(Message(10 + number, clock[0] - 0.25), "/lidar", 500 + 100 * number)
    ((publisher, grown, longest, oldest),) = logger.windows()
    assert publisher == "/lidar"
    assert grown == [5, 400, 0, 4, 4.0, 4.0, 5, pytest.approx(1.25), pytest.approx(5 * 0.0625)]
    assert (longest, oldest) == (1.0, pytest.approx(0.25))
    ((_, grown, longest, _),) = logger.windows()
    assert grown == [0] * 9
    assert longest == 0
    clock[0] += 3
    logger.callback(Message(15), "/lidar", 1000)
    assert logger.windows()[0][2] == 3.0, "the gap across windows belongs to the later one"


def test_a_gap_of_numbers_counts_all_that_are_missing(clock):
    logger = LightLogger(subscriber())
    for sequence in (7, 8, 12, 12, 1, 2):
        logger.callback(Message(sequence), "/lidar", 0)
    assert logger.windows()[0][1][2] == 3


def test_messages_without_a_header_have_no_age(clock):
    logger = LightLogger(subscriber())
    logger.callback(Message(), "/lidar", 10)
    assert logger.windows()[0][1][6] == 0


def test_a_publisher_that_is_gone_and_silent_is_forgotten(clock):
    logger = LightLogger(subscriber(publishers=()))
    logger.callback(Message(), "/lidar", 10)
    assert len(logger.windows()) == 1
    assert len(logger.windows()) == 1
    assert logger.windows() == []


def test_time_that_jumps_back_is_no_negative_gap(clock):
    logger = LightLogger(subscriber())
    logger.callback(Message(), "/lidar", 10)
    clock[0] = 50.0
    logger.callback(Message(), "/lidar", 20)
    ((_, grown, longest, _),) = logger.windows()
    assert (grown[0], grown[3], longest) == (2, 0, 0.0)


@pytest.mark.parametrize("name", ["/clock", "/statistics"])
def test_topics_that_would_tell_of_themselves_are_left_out(clock, name):
    logger = LightLogger(subscriber(name))
    logger.callback(Message(1), "/lidar", 10)
    assert logger.windows() == []
    assert not ros1_statistics._TELLER.loggers


def test_a_closed_subscriber_tells_no_more(clock):
    logger = LightLogger(subscriber())
    assert ros1_statistics._TELLER.loggers == {logger}
    logger.shutdown()
    assert not ros1_statistics._TELLER.loggers


def test_an_error_ends_the_counting_and_not_the_node(clock, capsys):
    logger = LightLogger(subscriber())
    logger.callback(object(), "/lidar", 10)
    logger.callback(object(), "/lidar", 10)
    assert capsys.readouterr().err.count("/scan is no longer counted") == 1


class Original:
    is_enabled = callback = shutdown = print


def topics(**parts):
    module = types.ModuleType("rospy.topics")
    vars(module).update(parts)
    return module


def test_the_logger_is_replaced_where_rospy_is_as_expected(monkeypatch):
    module = topics(SubscriberStatisticsLogger=Original, _SubscriberImpl=object)
    hook_topics(module)
    assert module.SubscriberStatisticsLogger is LightLogger
    module = topics(SubscriberStatisticsLogger=Original, _SubscriberImpl=object)
    monkeypatch.setenv(ros1_statistics.SWITCH, "0")
    hook_topics(module)
    assert module.SubscriberStatisticsLogger is Original


@pytest.mark.parametrize(
    "parts",
    [{}, {"SubscriberStatisticsLogger": Original}, {"_SubscriberImpl": object},
     {"SubscriberStatisticsLogger": object, "_SubscriberImpl": object},
     {"SubscriberStatisticsLogger": print, "_SubscriberImpl": object}],
)  # fmt: skip
def test_another_rospy_is_left_as_it_is(parts):
    module = topics(**parts)
    hook_topics(module)
    assert module.__dict__.get("SubscriberStatisticsLogger") is parts.get("SubscriberStatisticsLogger")


@pytest.mark.parametrize(
    ("sums", "reported"),
    [((0, 0, 0, 0), (0, 0, 0)), ((4, 4.0, 4.0, 1.0), (1, 0, 1)), ((2, 4.0, 10.0, 3.0), (2, 1, 3)),
     ((1, 1e12, 1e24, 1e12), (2**31 - 1, 0, 2**31 - 1))],
)  # fmt: skip
def test_mean_deviation_and_greatest(sums, reported):
    assert ros1_statistics._three(*sums) == reported


def test_it_reads_as_old_python():
    import ast
    from pathlib import Path

    ast.parse(Path(ros1_statistics.__file__).read_text(), feature_version=(3, 8))
    assert "msgspec" not in Path(ros1_statistics.__file__).read_text()
