"""Drafts from scripted traffic, read back and held against it."""

import random
from itertools import zip_longest

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.drafting.draft import Observed
from roslens.live.drafting.draft_groups import grouped, pattern_of
from roslens.live.drafting.draft_lines import rounded
from roslens.live.drafting.draft_presence import There
from roslens.live.drafting.draft_text import Beside, draft_text
from roslens.live.join.session import Session
from roslens.live.window.signals import BY_KEY
from roslens.model.traffic.tally import Moments, Observer, Tally
from roslens.model.wire import VERSION, Frame


def tallies(topic, times, publisher="/p"):
    """Return one tally a second of messages at these times."""
    found, previous = [], None
    for second in range(int(max(times)) + 1):
        inside = [time for time in times if second <= time < second + 1]
        gaps = []
        for time in inside:
            if previous is not None:
                gaps.append(time - previous)
            previous = time
        period = (
            Moments(len(gaps), sum(gaps), sum(gap * gap for gap in gaps), min(gaps), max(gaps)) if gaps else Moments()
        )
        found.append(Tally(topic, publisher, "", second, second + 1, len(inside), period=period))
    return found


def steady(hertz, seconds, jitter=0.0, seed=1):
    rng = random.Random(seed)
    return [0.01 + number / hertz + rng.uniform(-jitter, jitter) for number in range(1, int(hertz * seconds))]


def observed(*series):
    found = Observed()
    for step in zip_longest(*series):
        found.add(tally for tally in step if tally is not None)
    return found


def lines_of(found, topic="/scan"):
    (one,) = (one for one in found.drafted() if one.names == (topic,))
    return {line.quantity: line for line in one.lines}


@pytest.mark.parametrize(
    ("hertz", "seconds", "periods"), [(2.5, 120, 2.5), (2.5, 60, 4.0), (10, 120, 8.8), (1, 300, 4)]
)
def test_a_second_of_silence_is_outside_where_nothing_was_missing_on_a_slow_topic(hertz, seconds, periods):
    bound = lines_of(observed(tallies("/scan", steady(hertz, seconds, 0.005))))["largest_gap"].range.maximum
    assert bound == pytest.approx(periods / hertz, rel=0.02)


def test_where_messages_of_a_slow_topic_were_missing_four_periods_are_let_pass():
    times = [time for number, time in enumerate(steady(2.5, 120, 0.005)) if number not in (30, 90, 150)]
    assert lines_of(observed(tallies("/scan", times)))["largest_gap"].range.maximum == pytest.approx(1.6, rel=0.02)


def test_steady_traffic():
    found = observed(tallies("/scan", steady(20, 100, 0.001)))
    lines = lines_of(found)
    assert lines["rate"].range == Range(18, 22.1)
    assert lines["largest_gap"].range.maximum == pytest.approx(0.42, abs=0.02)
    assert [line.outside for line in lines.values()] == [0, 0]
    assert found.drafted()[0].window == 5


def test_what_came_before_the_first_message_is_no_silence():
    late = tallies("/scan", [at + 40 for at in steady(20, 60, 0.001)])
    lines = lines_of(observed(tallies("/odom", steady(50, 100)), late))
    assert lines["rate"].range.minimum == pytest.approx(18, rel=0.02)
    assert lines["largest_gap"].range.maximum < 0.5
    assert [line.outside for line in lines.values()] == [0, 0]


def test_one_drop_out_is_an_outlier_and_leaves_the_band_as_it_is():
    times = [time for time in steady(50, 60) if not 30.0 < time < 33.0]
    lines = lines_of(observed(tallies("/imu", times)), "/imu")
    assert lines["rate"].range.minimum == pytest.approx(45, rel=0.01)
    assert lines["rate"].range.maximum == pytest.approx(55, rel=0.01)
    assert lines["largest_gap"].range.maximum < 0.3
    assert [line.outside for line in lines.values()] == [1, 1]
    assert lines["largest_gap"].alarms_per_hour == pytest.approx(3600 / 60)


def test_gaps_that_come_again_are_usual():
    times = [time for time in steady(50, 120) if not any(at < time < at + 1.1 for at in (20, 40, 60, 80, 100))]
    lines = lines_of(observed(tallies("/imu", times)), "/imu")
    assert lines["largest_gap"].range.maximum == pytest.approx(1.15 * 1.11, rel=0.02)
    assert [line.outside for line in lines.values()] == [0, 0]


@pytest.mark.parametrize("hertz", [1, 5, 20, 100])
def test_half_and_two_thirds_of_a_rate_and_twice_as_much_are_outside(hertz):
    rate = lines_of(observed(tallies("/scan", steady(hertz, 200, 0.1 / hertz))))["rate"]
    assert hertz in rate.range
    assert all(hertz * share not in rate.range for share in (0.5, 0.667, 2))


def test_a_band_is_as_wide_as_the_gaps_that_are_let_pass():
    calm = lines_of(observed(tallies("/scan", steady(10, 300, 0.01))))
    assert 8 <= calm["rate"].range.minimum <= 9
    assert 11 <= calm["rate"].range.maximum <= 12
    # What stands still for most of a second now and then is low for as long, and that is as it was.
    times = [time for time in steady(10, 300) if not any(at < time < at + 0.8 for at in range(20, 300, 20))]
    halting = lines_of(observed(tallies("/scan", times)))
    assert halting["rate"].range.minimum < calm["rate"].range.minimum
    assert halting["rate"].outside == 0


@pytest.mark.parametrize(
    ("topic", "type_"),
    [
        ("/cmd_vel", "geometry_msgs/msg/Twist"),
        ("/joy", "sensor_msgs/Joy"),
        ("/drive_cmd", "geometry_msgs/msg/TwistStamped"),
        ("/drive", "ackermann_msgs/msg/AckermannDriveStamped"),
    ],
)
def test_commands_are_there_and_their_rate_is_left_out(topic, type_):
    found = observed(tallies(topic, steady(10, 60)), tallies("/twist", steady(10, 60)))
    found.add_types([(topic, type_), ("/twist", "geometry_msgs/msg/TwistStamped")])
    text = draft_text("mine", grouped(found.drafted()), found.left_out(), "a bag")
    reference = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY)
    assert [one.selector.name for one in reference.presences] == [topic]
    assert {one.selector.name for one in reference.expectations} == {"/twist"}
    assert "    # rate: " in text
    assert "a command, which comes for as long as it is given" in text
    live = draft_text("mine", found.drafted(), (), "a watch", Beside((There("topic", topic, type_, 60, 60, 0, 0.1),)))
    assert "    # rate: " in live
    assert not any(
        one.selector.name == topic for one in load_reference([GivenText("d", live.encode())], BY_KEY).expectations
    )


def test_events_are_no_rate():
    rng = random.Random(1)
    poisson = sorted(rng.uniform(0, 300) for _ in range(300))
    joystick = [at + step / 10 for at in range(10, 300, 40) for step in range(int(rng.uniform(20, 200)))]
    found = observed(tallies("/clicked", poisson), tallies("/joy", joystick), tallies("/rosout", steady(10, 300)))
    assert [(one.names, one.lines) for one in found.drafted()] == [(("/clicked",), ()), (("/joy",), ())]
    found.add_types([("/joy", "sensor_msgs/Joy")])
    text = draft_text("mine", grouped(found.drafted()), found.left_out(), "a bag")
    reference = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY)
    assert reference.expectations == ()
    assert [one.selector.name for one in reference.presences] == ["/clicked", "/joy"]
    assert "no steady rate: 0 to" in text


@pytest.mark.parametrize("seed", range(8))
def test_slow_events_are_no_rate(seed):
    rng = random.Random(seed)
    by_chance = sorted(rng.uniform(0, 600) for _ in range(100))
    lossy = [at for at in steady(0.5, 600, 0.2, seed) if rng.random() > 0.1]
    found = observed(tallies("/event", by_chance), tallies("/status", lossy))
    assert [(one.names[0], bool(one.lines)) for one in found.drafted()] == [("/event", False), ("/status", True)]


def test_events_that_were_not_always_there_are_listed():
    joystick = [at + step / 10 for at in range(10, 300, 40) for step in range(20 + at)]
    found = observed(tallies("/joy", joystick), tallies("/key", joystick))
    there = [There("topic", "/joy", "", 60, 60, 0, 0.1)]
    text = draft_text("mine", found.drafted(), (), "a watch", Beside(tuple(there)))
    reference = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY)
    assert [one.selector.name for one in reference.presences] == ["/joy"]
    assert "not always there:\n#   /key: " in text


def test_a_topic_that_ended_says_no_rate():
    found = observed(tallies("/odom", steady(50, 100)), tallies("/scan", steady(20, 40)))
    assert {one.names[0]: bool(one.lines) for one in found.drafted()} == {"/odom": True, "/scan": False}


def test_a_longer_window_is_taken_where_only_that_is_steady():
    # Ten messages at once every three seconds.
    bursts = [at + step * 0.01 for at in range(0, 600, 3) for step in range(10)]
    (one,) = observed(tallies("/cloud", bursts)).drafted()
    assert one.lines
    assert one.window > 5


def test_slow_topics_have_long_windows():
    (one,) = observed(tallies("/scan", steady(0.3, 600))).drafted()
    assert one.window == pytest.approx(67)
    lines = {line.quantity: line for line in one.lines}
    assert lines["rate"].range.minimum > 0.2
    assert lines["largest_gap"].range.maximum >= 4 / 0.3 - 0.01
    assert [line.outside for line in one.lines] == [0, 0]


def test_too_little_is_left_out():
    found = observed(tallies("/scan", steady(10, 3)), tallies("/once", [1.0, 2.5]))
    assert found.drafted() == ()
    assert found.left_out() == ("/once", "/scan")


def test_the_rates_of_two_publishers_add_up_as_they_do_when_judged():
    one, other = tallies("/scan", steady(10, 60), "/a"), tallies("/scan", steady(20, 60), "/b")
    found = observed(one, other)
    lines = lines_of(found)
    assert lines["rate"].typical == pytest.approx(30, rel=0.06)
    assert lines["largest_gap"].typical == pytest.approx(0.1, rel=0.06)
    text = draft_text("mine", found.drafted(), (), "a script").encode()
    session = Session(load_reference([GivenText("draft.yaml", text)], BY_KEY), start=0.0)
    for step in zip_longest(one, other):
        session.take([Frame(VERSION, "s", 0, step[0].end, list(step))])
        assert [verdict for verdict in session.look(step[0].end).changes if verdict.state.bad] == []


def test_stretches_of_any_length_are_spread_over_steps():
    found, times = Observed(), steady(20, 60)
    at = 0.0
    while at < 59:
        end = at + 0.83
        inside = [time for time in times if at <= time < end]
        gaps = Moments(len(inside), 0.05 * len(inside), 0.0, 0.05, 0.05)
        seen = [("", Observer.INSIDE), ("/b", Observer.INSIDE), ("/b", Observer.TAP)]
        found.add_live(
            Tally("/scan", "/a", subscriber, 1e9 + at, 1e9 + end, len(inside), period=gaps, observer=observer)
            for subscriber, observer in seen
        )
        at = end
    rate = lines_of(found)["rate"]
    assert rate.typical == pytest.approx(20, rel=0.01)
    assert rate.outside == 0
    assert found.drafted()[0].messages == pytest.approx(20 * 59, rel=0.02)


@given(st.floats(-1e3, 1e9), st.floats(0, 600))
def test_shares_are_whole(start, length):
    shares = Observed()._shares(start, start + length)
    if shares:
        assert sum(share for _, share in shares) == pytest.approx(1.0) or start < 0
        assert [number for number, _ in shares] == list(range(shares[0][0], shares[-1][0] + 1))


def test_a_clock_that_jumps_makes_no_endless_windows():
    found = Observed()
    found.add_live([Tally("/scan", "/a", "", 0.0, 1.0, 10), Tally("/scan", "/a", "", 1.0, 1e9, 10)])
    found.add_live([Tally("/scan", "/a", "", -5.0, -4.0, 10), Tally("/scan", "/a", "", 2.0, 1.0, 10)])
    assert found.left_out() == ("/scan",)


def test_likes_are_joined_and_unlikes_are_not():
    names = ("/camera_left/image", "/camera_right/image", "/camera_rear/image", "/lidar/image")
    rates = (20, 20, 5, 20)
    found = observed(*(tallies(name, steady(rate, 60)) for name, rate in zip(names, rates, strict=True)))
    found.add_types((name, "sensor_msgs/Image" if "camera" in name else "other/Type") for name in names)
    groups = grouped(found.drafted())
    assert [one.names for one in groups] == [
        ("/camera_left/image", "/camera_right/image"),
        ("/camera_rear/image",),
        ("/lidar/image",),
    ]
    assert pattern_of(groups[0].names) == "/{camera_left,camera_right}/image"


@given(st.lists(st.text("ab*?{},\\é-", min_size=1, max_size=6), min_size=1, max_size=4, unique=True))
def test_a_pattern_matches_its_names_and_no_other(names):
    pattern = Pattern.parse(pattern_of(tuple(sorted(f"/x/{name}/y" for name in names))))
    assert all(pattern.matches(f"/x/{name}/y") for name in names)
    assert not pattern.matches("/x/another/y")


def test_the_document_reads_back():
    found = observed(
        tallies("/a", steady(20, 60)),
        tallies("/b{1}", steady(5, 60)),
        tallies("/few", [1.0]),
        tallies("/é", steady(9, 60)),
    )
    found.add_types([("/a", "std_msgs/msg/String")])
    text = draft_text("mine", grouped(found.drafted()), found.left_out(), 'my "bag"')
    reference = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY)
    assert reference.name == "mine"
    quantities = [(one.selector.name, one.quantity) for one in reference.expectations]
    assert len(quantities) == 6
    assert ("/a", "rate") in quantities
    assert "#   /few" in text
    assert "outside 0 times in 60 s: at most" in text


def test_nothing_to_draft_is_said():
    text = draft_text("mine", (), ["/few"], "a bag")
    assert "constraints: []" in text


@pytest.mark.parametrize(
    ("value", "up", "expected"),
    [(0.03, True, 0.03), (0.12345, True, 0.124), (0.12345, False, 0.123), (1234.0, True, 1240.0), (0.0, True, 0.0)],
)
def test_rounding_goes_outward(value, up, expected):
    assert rounded(value, up=up) == pytest.approx(expected)
