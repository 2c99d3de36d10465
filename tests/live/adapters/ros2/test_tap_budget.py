import time

from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros2.tap import Tap, _Open, matcher, within


def test_all_that_fit_are_chosen():
    assert within({"/a": 0.01, "/b": 0.02, "/c": 0.0}, 0.1, 0) == ["/a", "/b", "/c"]


def test_those_that_do_not_fit_come_in_turn():
    costs = {"/a": 0.06, "/b": 0.06, "/c": 0.06}
    assert within(costs, 0.1, 0) == ["/a"]
    assert within(costs, 0.1, 1) == ["/b"]
    assert within(costs, 0.1, 5) == ["/c"]


def test_one_that_is_too_dear_alone_waits_until_the_debt_is_paid():
    assert within({"/a": 0.5}, 0.1, 0) == ["/a"]
    assert within({"/a": 0.5}, -0.4, 0) == []
    assert within({}, 0.1, 3) == []


@given(st.dictionaries(st.text(min_size=1), st.floats(0.001, 1), min_size=1), st.floats(0, 2))
def test_every_topic_gets_its_turn(costs, credit):
    seen, first = set(), 0
    for _ in range(2 * len(costs)):
        chosen = within(costs, credit, first)
        seen |= set(chosen)
        first += max(1, len(chosen))
    assert seen == set(costs)


def test_stars_stay_within_a_part_of_the_name_and_double_stars_do_not():
    assert matcher("/demo/*")("/demo/chatter")
    assert not matcher("/demo/*")("/demo/a/b")
    assert matcher("/**")("/demo/a/b")
    assert matcher("/a?.[x]")("/ab.[x]")
    assert not matcher("/a?.[x]")("/a/.[x]")


class Queue:
    """A subscription from which messages are taken."""

    msg_type = None

    def __init__(self):
        self.waiting = []
        self.handle = self

    def take_message(self, kind, raw):
        return self.waiting.pop(0) if self.waiting else None

    def put(self, gid, number):
        info = {"publisher_gid": {"data": gid}, "received_timestamp": 2 * 10**9, "source_timestamp": 10**9}
        self.waiting.append((b"message", {**info, "publication_sequence_number": number}))


def test_a_node_that_crashed_and_came_back_has_one_connection_which_counts_the_living_publisher():
    """A dead publisher stays in the graph for a while, beside the one that took its place."""
    old, new = bytes(range(16)), bytes(range(16, 32))
    names = {old.hex(): "/lidar", new.hex(): "/lidar"}
    queue = Queue()
    tap = Tap(None, ["/scan"], 100.0, "base")
    tap._ends, tap._costs, tap._open = {"/scan": []}, {"/scan": 0.0}, {"/scan": _Open(queue, "/scan")}
    now = time.time()
    for second, (gid, count) in enumerate([(old, 1), (new, 2), (new, 3)], 1):
        for number in range(count):
            queue.put(gid, 10 * second + number)
        (tally,) = tap.tallies(now + second, names.get)
        assert (tally.publisher, tally.count, tally.host) == ("/lidar", count, "base")
    del names[old.hex()]
    (tally,) = tap.tallies(now + 4, names.get)
    assert (tally.publisher, tally.count) == ("/lidar", 0)
