import pytest

from roslens.judge.patterns.pattern import Pattern
from roslens.live.adapters.ros1.listening import Taken
from roslens.live.adapters.ros1.subscribed_topics import SILENT_ROUNDS, SubscribedTopics
from roslens.live.adapters.ros1.wire.stream import Source, Use
from roslens.model.traffic.tally import Observer, Tally
from roslens.model.wire import VERSION, Frame

TEXT = b"\0\0\0\0"
STATUS = b"".join([bytes(12), TEXT, b"\1\0\0\0", b"\2", b"\5\0\0\0motor", b"\3\0\0\0hot", TEXT, b"\0\0\0\0"])
TOLD = Tally("/t", "/a", "/b", 0.0, 1.0, 10, 300, observer=Observer.INSIDE)


class Observation:
    publishers = {"/scan": [("/lidar", "http://l:1/")], "/statistics": [("/b", "http://b:1/")], "/other": []}  # noqa: RUF012
    unframed = frozenset()

    def round(self, moved):
        return Frame(VERSION, "vm/ros1", 0, 1.0, shed=1)


class Listening:
    wanted = None

    def want(self, sources):
        self.wanted = sources

    def take(self):
        return Taken([TOLD], [], 2)


@pytest.fixture
def make():
    def build(taps=(), statistics=False):
        subscribed = SubscribedTopics(Observation(), Listening(), [Pattern.parse(text) for text in taps], statistics)
        return subscribed, subscribed._observation, subscribed._listening

    return build


def test_nothing_is_listened_to_unasked(make):
    subscribed, _, listening = make()
    assert subscribed.round().tallies == []
    assert listening.wanted is None


def test_other_monitors_are_listened_to_and_their_levels_are_events():
    class Observing(Observation):
        publishers = {"/diagnostics": [("/monitor", "http://m:1/"), ("/me", "http://me:1/")]}  # noqa: RUF012

    class PatternSubscriber(Listening):
        def take(self):
            return Taken(
                reports=[
                    ("/monitor", 5.0, STATUS),
                    ("/monitor", 6.0, b"odd"),
                    ("/monitor", 7.0, STATUS + b"x" * 9),
                    ("/monitor", 8.0, b""),
                ]
            )

    listening = PatternSubscriber()
    frame = SubscribedTopics(Observing(), listening, [], False, "/me", reports=True).round()
    assert listening.wanted == [Source(Use.REPORTS, "/diagnostics", "/monitor", "http://m:1/")]
    (event,) = frame.events
    assert (event.time, event.entity) == (5.0, "node:/monitor")
    assert event.detail == "diagnostics: 'motor' is ERROR, was OK: hot"
    (failure,) = frame.failures
    assert "/monitor sends no diagnostics" in failure.what


def test_patterns_choose_topics(make):
    subscribed, _, listening = make(["/sc*"])
    assert subscribed.round().shed == 3
    assert listening.wanted == [Source(Use.TAP, "/scan", "/lidar", "http://l:1/")]


def test_statistics_are_read_from_all_who_publish_them(make):
    subscribed, _, listening = make(statistics=True)
    subscribed.round()
    assert listening.wanted == [Source(Use.STATISTICS, "/statistics", "/b", "http://b:1/")]


def test_the_lengths_that_rospy_counts_are_taken_off_and_roscpp_counts_none(make):
    subscribed, observation, _ = make(statistics=True)
    assert subscribed.round().tallies[0].bytes == 260
    observation.unframed = frozenset({"/b"})
    assert subscribed.round().tallies[0].bytes == 300


def test_statistics_that_nobody_publishes_are_named_once_and_no_failure(make):
    subscribed, observation, _ = make(statistics=True)
    observation.publishers = {}
    frames = [subscribed.round() for _ in range(3 * SILENT_ROUNDS)]
    assert [failure for frame in frames for failure in frame.failures] == []
    (event,) = [event for frame in frames for event in frame.events]
    assert "/enable_statistics" in event.detail


def test_what_subscribers_tell_of_what_we_publish_ourselves_is_left_out():
    class PatternSubscriber(Listening):
        def take(self):
            own = Tally("/diagnostics", "/me", "/b", 0.0, 1.0, 10, 300, observer=Observer.INSIDE)
            return Taken([TOLD, own])

    subscribed = SubscribedTopics(Observation(), PatternSubscriber(), [], True, "/me")
    assert [(tally.topic, tally.publisher) for tally in subscribed.round().tallies] == [("/t", "/a")]
