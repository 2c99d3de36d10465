import random
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rosbags.typesys import Stores, get_typestore

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.unmatched import unmatched
from roslens.live.adapters.bag import steps
from roslens.live.adapters.bag.open_bag import open_bag
from roslens.live.replay.replay import replay
from roslens.live.window.signals import BY_KEY
from roslens.model.errors import UsageError
from roslens.model.graph import Node, Role
from roslens.model.traffic.tally import Observer
from roslens.model.verdict import State

START = 1_700_000_000_000_000_000
SAME = settings(max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


def generation(kind):
    return "ros1" if kind.startswith("ros1") else "ros2"


def some_rows(count, kind, content_of, topics=("/a", "/b", "/c"), seed=1):
    chance = random.Random(seed)
    time = START
    rows = []
    for _ in range(count):
        time += chance.choice([0, 1_000_000, 20_000_000, 700_000_000])
        late = chance.choice([0, 0, 0, 30_000_000])
        stamp = chance.choice([0, time - 5_000_000])
        rows.append((chance.choice(topics), time - late, content_of(stamp, generation(kind), chance.randrange(60))))
    return rows


def assert_same(found, expected, exact_sizes=True):
    assert [end for end, _ in found] == [end for end, _ in expected]
    for (_, mine), (_, plain) in zip(found, expected, strict=True):
        assert len(mine) == len(plain)
        for one, other in zip(mine, plain, strict=True):
            assert (one.topic, one.publisher, one.subscriber, one.start, one.end, one.count) == (
                other.topic, other.publisher, other.subscriber, other.start, other.end, other.count,
            )  # fmt: skip
            assert (one.first, one.last, one.observer) == (other.first, other.last, Observer.RECORDING)
            if exact_sizes:
                assert one.bytes == other.bytes
            for moments, others in ((one.period, other.period), (one.age, other.age)):
                assert moments.count == others.count
                assert (moments.total, moments.squares, moments.least, moments.greatest) == pytest.approx(
                    (others.total, others.squares, others.least, others.greatest), abs=1e-9
                )


@SAME
@given(
    st.lists(st.tuples(st.sampled_from(["/a", "/b"]), st.integers(0, 5_000_000_000), st.integers(0, 40)), max_size=60),
    st.sampled_from([0.05, 0.3, 1.0, 7.0]),
    st.sampled_from([1, 600, 1 << 20]),
    st.sampled_from([1, 20, 1 << 18]),
)
def test_tallies_are_those_of_counting_one_by_one(
    kind, recording, content_of, counted_plainly, entries, step, chunk, batch
):
    rows = [(topic, START + at, content_of(START + at // 2, generation(kind), extra)) for topic, at, extra in entries]
    with tempfile.TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr("roslens.live.adapters.bag.bag._BATCH", batch)
        bag = open_bag(recording(Path(folder), kind, rows, chunk, topics=["/a"]))
        found = list(bag.tallies(step, [topic.name for topic in bag.topics]))
        expected = counted_plainly(rows, round(step * 1e9), generation(kind), True)
        kept = [
            (end, [tally for tally in tallies if tally.topic in {row[0] for row in rows}]) for end, tallies in found
        ]
        assert_same(kept, expected)
        assert bag.messages == len(rows)
        assert not bag.failures


def test_a_long_recording_agrees_with_what_the_library_reads(
    tmp_path, kind, recording, content_of, counted_plainly, read_by_library
):
    path = recording(tmp_path, kind, some_rows(3000, kind, content_of), 20_000)
    rows = read_by_library(path)
    bag = open_bag(path)
    assert_same(list(bag.tallies(2.5)), counted_plainly(rows, 2_500_000_000, generation(kind), False))
    assert bag.start == min(time for _, time, _ in rows) / 10**9
    assert bag.end == max(time for _, time, _ in rows) / 10**9
    assert {topic.name: topic.count for topic in bag.topics} == Counter(row[0] for row in rows)
    for name in ("/a", "/b"):
        expected = sorted(time for topic, time, _ in rows if topic == name)
        times = bag.times(name)
        assert times.dtype == np.int64
        assert times.tolist() == expected


def test_what_is_known_of_topics(tmp_path, kind, recording, content_of):
    bag = open_bag(recording(tmp_path, kind, some_rows(50, kind, content_of)))
    topic = bag.topics[0]
    assert bag.generation == generation(kind)
    assert topic.stamped
    if bag.generation == "ros1":
        assert (topic.type, topic.hash) == ("geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5")
        assert topic.publishers == ("/node/a",)
        assert bag.graph().nodes == tuple(Node(f"/node/{name}") for name in "abc")
    else:
        assert topic.type == "geometry_msgs/msg/PoseStamped"
        assert topic.publishers == ()
        assert bag.graph().nodes == ()
    endpoints = bag.graph().endpoints
    assert [(end.name, end.role) for end in endpoints] == [(f"/{name}", Role.PUBLISHER) for name in "abc"]
    assert endpoints[0].hash == topic.hash
    assert bag.exact_sizes == (kind == "sqlite")


def test_no_messages_are_no_steps(tmp_path, kind, recording):
    bag = open_bag(recording(tmp_path, kind, [], topics=["/a"]))
    assert list(bag.tallies()) == []
    assert (bag.messages, bag.start, bag.end, bag.failures) == (0, 0.0, 0.0, ())
    assert [topic.name for topic in bag.topics] == ["/a"]
    assert bag.times("/a").tolist() == []


@pytest.mark.parametrize("name", ["chatter", "/chatter"])
@pytest.mark.parametrize("kind", ["ros1", "mcap", "sqlite"])
def test_a_name_without_a_slash_is_the_one_that_playing_makes_of_it(tmp_path, kind, name, recording):
    rows = [("chatter", START + number * 50_000_000, poses(generation(kind), 1)[0][2]) for number in range(100)]
    bag = open_bag(recording(tmp_path, kind, rows))
    assert [topic.name for topic in bag.topics] == ["/chatter"]
    assert len(bag.times("/chatter")) == 100
    lines = f"constraints:\n  - {{topic: {name}, rate: 18..22 Hz}}\n"
    lines += f"fields:\n  - {{topic: {name}, field: pose.position.y, range: 2..3}}\n"
    reference = load_reference([GivenText("r.yaml", f"kind: reference\nname: r\n{lines}".encode())], BY_KEY)
    session = replay(bag, reference, report=lambda _: None)
    assert {verdict.state for verdict in session.monitor.standing()} == {State.OK}
    assert unmatched(reference, session.seen()) == []


def poses(generation, count):
    store = get_typestore(Stores.ROS1_NOETIC if generation == "ros1" else Stores.LATEST)
    kinds = store.types
    rows = []
    for number in range(count):
        time = kinds["builtin_interfaces/msg/Time"](1_700_000_000, number)
        fields = {"stamp": time, "frame_id": "map"} | ({"seq": number} if generation == "ros1" else {})
        header = kinds["std_msgs/msg/Header"](**fields)
        point = kinds["geometry_msgs/msg/Point"](float(number), 2.0, float("nan"))
        turn = kinds["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
        message = kinds["geometry_msgs/msg/PoseStamped"](header, kinds["geometry_msgs/msg/Pose"](point, turn))
        write = store.serialize_ros1 if generation == "ros1" else store.serialize_cdr
        rows.append(
            ("/pose", START + (number ^ 1) * 10_000_000, bytes(write(message, "geometry_msgs/msg/PoseStamped")))
        )
    return rows


@pytest.mark.parametrize("kind", ["ros1", "ros1_bz2", "mcap_zstd", "sqlite", "sqlite_message", "mcap_message"])
def test_fields_are_decoded_in_the_order_of_receipt(tmp_path, recording, kind):
    path = recording(tmp_path, kind, poses(generation(kind), 20), 700)
    bag = open_bag(path.parent if kind.endswith("message") else path)
    wanted = {
        "/pose": ["pose.position.x", "pose.position.z", "header.stamp.nanosec", "header.frame_id", "pose.nothing"]
    }
    found = list(bag.fields(wanted))
    assert [time for time, _, _ in found] == [(START + number * 10_000_000) / 10**9 for number in range(20)]
    assert [values["pose.position.x"] for _, _, values in found] == [float(number ^ 1) for number in range(20)]
    assert found[0][1] == "/pose"
    assert np.isnan(found[0][2]["pose.position.z"])
    assert found[0][2].keys() == {"pose.position.x", "pose.position.z", "header.stamp.nanosec"}
    reported = [failure.what for failure in bag.failures]
    assert [text.split('"')[3] for text in reported] == ["header.frame_id", "pose.nothing"]


def test_a_message_that_cannot_be_decoded_loses_no_other(tmp_path, kind, recording):
    rows = poses(generation(kind), 4)
    rows[2] = ("/pose", rows[2][1], b"\x00\x01\x00\x00short")
    bag = open_bag(recording(tmp_path, kind, rows))
    assert len(list(bag.fields({"/pose": ["pose.position.x"]}))) == 3
    assert "cannot be decoded" in bag.failures[0].what


def test_what_is_not_there_is_named(tmp_path, recording, content_of):
    bag = open_bag(recording(tmp_path, "mcap", some_rows(10, "mcap", content_of)))
    for call in (lambda: bag.times("/x"), lambda: bag.tallies(1.0, ["/x"]), lambda: bag.fields({"/x": ["y"]})):
        with pytest.raises(UsageError, match='topic "/x"; expected one of /a, /b, /c'):
            call()
    for step in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(UsageError, match="a step of"):
            bag.tallies(step)
    assert list(bag.fields({"/a": ["pose..x"]})) == []
    assert "not a path of a field" in bag.failures[-1].what


def test_split_files_are_one_recording(tmp_path, kind, recording, content_of, counted_plainly):
    rows = sorted(some_rows(300, kind, content_of), key=lambda row: row[1])
    paths = []
    for index in range(3):
        folder = tmp_path / str(index)
        folder.mkdir()
        paths.append(recording(folder, kind, rows[index * 100 : index * 100 + 100], 2_000))
    bag = open_bag(list(reversed(paths)))
    assert bag.messages == 300
    assert [topic.name for topic in bag.topics] == ["/a", "/b", "/c"]
    assert_same(list(bag.tallies(3.0)), counted_plainly(rows, 3_000_000_000, generation(kind), False))
    assert not bag.failures


def test_a_jump_of_the_clock_is_shortened_and_told(tmp_path, kind, recording, content_of):
    rows = [("/a", time, content_of(0, generation(kind))) for time in (1_000_000_000, 1_500_000_000, START)]
    bag = open_bag(recording(tmp_path, kind, rows))
    found = list(bag.tallies(1.0))
    assert len(found) == 1 + steps.LONGEST_QUIET + 1
    assert found[-1][1][0].count == 1
    assert found[-1][1][0].period.greatest == pytest.approx(START / 10**9 - 1.5)
    assert "nothing at all between" in bag.failures[0].what


def test_reading_twice_tells_nothing_twice(tmp_path, recording, content_of):
    path = recording(tmp_path, "mcap", some_rows(100, "mcap", content_of))
    path.write_bytes(path.read_bytes()[:-20])
    bag = open_bag(path)
    first = list(bag.tallies())
    reported = bag.failures
    assert reported
    assert list(bag.tallies()) == first
    assert bag.failures == reported
