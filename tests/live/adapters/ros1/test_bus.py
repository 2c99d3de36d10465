import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros1.bus import Bus, Reading, grown
from roslens.live.adapters.ros1.slave import BusStats, Counter, Link
from roslens.model.traffic.tally import NOTHING, Observer

HOMES = {"http://h:1": "/talker", "http://h:2": "/listener"}


def talker(time, count, wraps=False, prefix=4, size=30, uri="http://h:1/", id_="1"):
    stats = BusStats((Counter(id_, "/chat", True, count, count * size + 700, prefix),), wraps)
    return Reading("/talker", uri, time, stats, (Link(id_, "/chat", True, "/listener"),))


def listener(time, count, drops=-1, wraps=False, peer="http://h:1/"):
    stats = BusStats((Counter("7", "/chat", False, count, count * 26, 0, drops),), wraps)
    return Reading("/listener", "http://h:2/", time, stats, (Link("7", "/chat", False, peer),))


def test_the_first_sight_counts_nothing_and_the_second_the_growth():
    bus = Bus(host="vm")
    assert bus.tallies([talker(10.0, 1000)], HOMES) == []
    (tally,) = bus.tallies([talker(12.0, 1060)], HOMES)
    assert (tally.topic, tally.publisher, tally.subscriber) == ("/chat", "/talker", "/listener")
    assert (tally.start, tally.end, tally.count, tally.bytes, tally.lost) == (10.0, 12.0, 60, 60 * 26, -1)
    assert (tally.first, tally.last, tally.period, tally.latency, tally.age) == (0.0, 0.0, NOTHING, NOTHING, NOTHING)
    assert (tally.observer, tally.host) == (Observer.PROTOCOL, "vm")


def test_two_ends_of_a_connection_are_counted_once_by_what_arrived():
    bus = Bus()
    bus.tallies([talker(0.0, 0), listener(0.0, 0, drops=0)], HOMES)
    (tally,) = bus.tallies([talker(1.0, 50), listener(1.1, 48, drops=2)], HOMES)
    assert (tally.count, tally.bytes, tally.lost, tally.end) == (48, 48 * 26, 2, 1.1)


def test_the_sending_end_is_heard_where_the_other_is_silent():
    bus = Bus()
    bus.tallies([talker(0.0, 0), listener(0.0, 0)], HOMES)
    (tally,) = bus.tallies([talker(1.0, 50)], HOMES)
    assert (tally.subscriber, tally.count) == ("/listener", 50)


def test_silence_is_told():
    bus = Bus()
    bus.tallies([talker(0.0, 5)], HOMES)
    (tally,) = bus.tallies([talker(1.0, 5)], HOMES)
    assert (tally.count, tally.bytes) == (0, 0)


def test_a_publisher_whose_home_is_unknown_is_empty():
    bus = Bus()
    bus.tallies([listener(0.0, 0, peer="http://elsewhere:5/")], HOMES)
    (tally,) = bus.tallies([listener(1.0, 3, peer="http://elsewhere:5/")], HOMES)
    assert tally.publisher == ""


def test_our_own_connections_are_hidden():
    bus = Bus(frozenset({"/listener"}))
    bus.tallies([talker(0.0, 0)], HOMES)
    assert bus.tallies([talker(1.0, 9)], HOMES) == []


def test_another_process_or_connection_begins_anew():
    for change in ({"uri": "http://h:9/"}, {"id_": "2"}):
        bus = Bus()
        bus.tallies([talker(0.0, 500)], HOMES)
        assert bus.tallies([talker(1.0, 510, **change)], HOMES) == []
        (tally,) = bus.tallies([talker(2.0, 515, **change)], HOMES)
        assert tally.count == 5


def test_counters_that_fall_are_no_negative_traffic():
    bus = Bus()
    bus.tallies([talker(0.0, 500)], HOMES)
    assert bus.tallies([talker(1.0, 3)], HOMES) == []
    assert bus.tallies([talker(2.0, 4)], HOMES)[0].count == 1


def test_what_is_forgotten_begins_anew():
    bus = Bus()
    bus.tallies([talker(0.0, 500)], HOMES)
    bus.forget("/talker")
    assert bus.tallies([talker(1.0, 501)], HOMES) == []


def test_a_clock_that_does_not_move_forward_yields_nothing():
    bus = Bus()
    bus.tallies([talker(5.0, 1)], HOMES)
    assert bus.tallies([talker(5.0, 2)], HOMES) == []
    assert bus.tallies([talker(4.0, 3)], HOMES) == []


@given(st.integers(0, 2**40), st.integers(0, 2**31 - 1))
def test_counters_of_32_bits_go_on_after_their_end(before, growth):
    signed = lambda value: (value + 2**31) % 2**32 - 2**31  # noqa: E731
    assert grown(signed(before), signed(before + growth), wraps=True) == growth


@pytest.mark.parametrize(("before", "after", "found"), [(5, 9, 4), (5, 5, 0), (5, 4, None)])
def test_counters_that_do_not_wrap(before, after, found):
    assert grown(before, after, wraps=False) == found


def rounds(bus, seconds, sent, received, skew=0.0):
    """Return the tallies of rounds of half a second at these rates; the receiving end is read so much later."""
    found = []
    for turn in range(int(2 * seconds) + 1):
        time = turn / 2
        readings = [talker(time, int(time * sent)), listener(time + skew, int((time + skew) * received))]
        found.append({tally.subscriber: tally.count for tally in bus.tallies(readings, HOMES)})
    return found


def test_what_is_sent_is_told_where_nobody_receives_nearly_all_of_it():
    found = rounds(Bus(), 10, sent=10, received=0.77)
    # It takes a while to find out.
    assert {} in found[:1]
    assert all(one.keys() == {"/listener"} for one in found[1:4])
    assert [one[""] for one in found[5:]] == [5] * 16
    assert sum(one["/listener"] for one in found[1:]) == 7


@pytest.mark.parametrize("skew", [0.0, 0.1, -0.1])
@pytest.mark.parametrize("hertz", [1, 10, 1000])
def test_what_arrives_as_it_is_sent_is_told_once(hertz, skew):
    found = rounds(Bus(), 30, sent=hertz, received=hertz, skew=skew)
    assert all(one.keys() <= {"/listener"} for one in found)


def test_it_is_told_no_more_once_all_arrives_again():
    bus = Bus()
    rounds(bus, 10, sent=10, received=1)
    before = {end: int(10 * rate) for end, rate in (("sent", 10), ("received", 1))}
    told = []
    for turn in range(1, 80):
        more = 5 * turn
        readings = [talker(10 + turn / 2, before["sent"] + more), listener(10 + turn / 2, before["received"] + more)]
        told.append("" in {tally.subscriber for tally in bus.tallies(readings, HOMES)})
    assert told[0]
    assert not any(told[-10:])


def test_of_one_who_receives_all_it_is_enough_to_say_that():
    bus, second = Bus(), "http://h:3/"
    for turn in range(40):
        count = 5 * turn
        counters = tuple(Counter(id_, "/chat", True, count, count * 30, 4) for id_ in "12")
        links = (Link("1", "/chat", True, "/listener"), Link("2", "/chat", True, "/slow"))
        sends = Reading("/talker", "http://h:1/", turn / 2, BusStats(counters, False), links)
        takes = Counter("9", "/chat", False, count // 13, count, 0)
        slow = Reading(
            "/slow", second, turn / 2, BusStats((takes,), False), (Link("9", "/chat", False, "http://h:1/"),)
        )
        found = {tally.subscriber for tally in bus.tallies([sends, listener(turn / 2, count), slow], HOMES)}
        assert found == ({"/listener", "/slow"} if turn else set())


def test_a_receiving_end_that_never_speaks_misses_nothing():
    bus = Bus()
    found = [bus.tallies([talker(turn / 2, 5 * turn)], HOMES) for turn in range(40)]
    assert all([tally.subscriber for tally in one] == ["/listener"] for one in found[1:])


def test_a_subscriber_that_was_started_again_is_found_to_miss_messages_anew():
    bus = Bus()
    rounds(bus, 10, sent=10, received=1)
    bus.forget("/listener")
    assert all("" not in one for one in rounds(bus, 1, sent=10, received=10))
