"""``roslens why a->b --bag``: the first cause of faults of transforms, and look-ups of a recording equal to tf2's."""

import json
import random

import pytest
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from tf2_answers import alike, has_tf2, mine, truths

from roslens.cli.main import main
from roslens.cli.why.recorded_transforms import transforms_of
from roslens.live.adapters.bag.open_bag import open_bag

STORE, STORE1 = get_typestore(Stores.LATEST), get_typestore(Stores.ROS1_NOETIC)
STORE1.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
START_NS = 1_700_000_000_000_000_000


def message(store, said, header):
    """Return a TFMessage of rows of parent, child and stamp in nanoseconds."""
    types = store.types
    place, turn = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Quaternion"]
    move = types["geometry_msgs/msg/Transform"](place(1.0, 0.0, 0.0), turn(0.0, 0.0, 0.0, 1.0))
    time = types["builtin_interfaces/msg/Time"]
    rows = [
        types["geometry_msgs/msg/TransformStamped"](header(time(*divmod(stamp, 10**9)), parent), child, move)
        for parent, child, stamp in said
    ]
    return types["tf2_msgs/msg/TFMessage"](rows)


def every(hertz, until, begin=0.0):
    return [begin + number / hertz for number in range(round((until - begin) * hertz))]


def recording(folder, streams, static=(), end=20.0):
    """Write transforms as streams of parent, child, seconds of receipt and lag of the stamps; one topic goes on."""
    kinds = {"/tf": "tf2_msgs/msg/TFMessage", "/beat": "std_msgs/msg/String"}
    kinds |= {"/tf_static": "tf2_msgs/msg/TFMessage"} if static else {}
    if not streams:
        del kinds["/tf"]
    header = STORE.types["std_msgs/msg/Header"]
    rows = [(at, "/beat", STORE.types["std_msgs/msg/String"]("x")) for at in (*every(10, end), end)]
    if static:
        rows.append((0.0, "/tf_static", message(STORE, [(*pair, START_NS) for pair in static], header)))
    for parent, child, times, lag in streams:
        rows += [
            (at, "/tf", message(STORE, [(parent, child, START_NS + round((at - lag) * 1e9))], header)) for at in times
        ]
    with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        lines = {name: writer.add_connection(name, kind, typestore=STORE) for name, kind in kinds.items()}
        for at, topic, one in sorted(rows, key=lambda row: row[:2]):
            writer.write(lines[topic], START_NS + round(at * 1e9), STORE.serialize_cdr(one, kinds[topic]))
    return folder


WHOLE = [("map", "odom", every(10, 20), 0.05), ("odom", "base_link", every(50, 20), 0.01)]
STATIC = [("base_link", "laser"), ("base_link", "camera")]


def asked(capsys, word, bag):
    code = main(["why", word, "--bag", str(bag), "--json", "-q"])
    answer = json.loads(capsys.readouterr().out)
    assert (code == 1) == (answer["cause"] is not None)
    return answer


def step(answer, asks):
    return next(one for one in answer["steps"] if one["asks"] == asks)


def test_a_whole_tree_has_no_cause_its_way_and_its_margin(tmp_path, capsys):
    answer = asked(capsys, "map->laser", recording(tmp_path / "bag", WHOLE, STATIC))
    assert answer["cause"] is None
    assert step(answer, "tree")["says"] == "the way is laser → base_link → odom → map"
    assert "base_link → laser: static, said 1 time" in step(answer, "sent")["evidence"]
    assert "extrapolation margin: the newest transform of all was 0.1" in step(answer, "last good")["evidence"][-1]


def test_two_trees_are_told_with_what_is_missing(tmp_path, capsys):
    answer = asked(capsys, "map->laser", recording(tmp_path / "bag", WHOLE[:1], STATIC))
    assert answer["cause"]["asks"] == "tree"
    assert "map and laser are in two trees" in answer["cause"]["says"]
    assert "from map to base_link" in answer["cause"]["how"]


def test_a_transform_that_stops_is_told_with_its_moment(tmp_path, capsys):
    stopped = [("map", "odom", every(10, 8), 0.05), WHOLE[1]]
    answer = asked(capsys, "map->base_link", recording(tmp_path / "bag", stopped))
    assert answer["cause"]["says"] == "map → odom stopped for 12.1 s from 7.90 s on, where it came every 0.1 s"


def test_two_parents_are_told(tmp_path, capsys):
    streams = [*WHOLE, ("world", "base_link", every(5, 20), 0.01)]
    answer = asked(capsys, "odom->base_link", recording(tmp_path / "bag", streams))
    assert answer["cause"]["asks"] == "tree"
    assert "base_link has 2 parents" in answer["cause"]["says"]


def test_a_loop_is_told(tmp_path, capsys):
    streams = [("a", "b", every(5, 20), 0), ("b", "a", every(5, 20), 0)]
    answer = asked(capsys, "a->b", recording(tmp_path / "bag", streams))
    assert "are a loop: " in answer["cause"]["says"]


def test_stamps_in_the_future_and_of_another_clock_are_told(tmp_path, capsys):
    answer = asked(capsys, "a->b", recording(tmp_path / "future", [("a", "b", every(10, 20), -1.8)]))
    assert answer["cause"]["says"] == "b has stamps up to 1.80 s in the future"
    mixed = [("a", "b", every(10, 20), 0), ("b", "c", every(10, 20), 1.6e9)]
    answer = asked(capsys, "a->c", recording(tmp_path / "mixed", mixed))
    assert "the stamps of c are of another clock" in answer["cause"]["says"]


def test_an_unknown_frame_has_the_nearest_names_and_what_was_not_recorded(tmp_path, capsys):
    bag = recording(tmp_path / "bag", WHOLE)
    answer = asked(capsys, "map->base_lnk", bag)
    assert answer["cause"]["says"] == '"base_lnk" is no frame that was said'
    assert "base_link for base_lnk" in answer["cause"]["how"]
    assert "/tf_static is not in the recording" in answer["cause"]["how"]


def test_a_recording_without_transforms_says_so(tmp_path, capsys):
    answer = asked(capsys, "map->base_link", recording(tmp_path / "bag", []))
    assert answer["cause"] is None
    assert step(answer, "exists")["state"] == "cannot be seen"
    assert "has neither /tf nor /tf_static" in step(answer, "exists")["says"]


def test_a_frame_alone_says_where_it_is(tmp_path, capsys):
    bag = recording(tmp_path / "bag", WHOLE, STATIC)
    answer = asked(capsys, "frame:laser", bag)
    assert step(answer, "tree")["says"] == "it is below map: laser → base_link → odom → map"
    assert asked(capsys, "frame:map", bag)["cause"] is None


def test_names_with_slashes_and_of_any_letters_are_frames(tmp_path, capsys):
    streams = [("/robot1/ödom", "/robot1/base link", every(10, 20), 0.01)]
    bag = recording(tmp_path / "bag", streams)
    assert asked(capsys, "robot1/ödom->robot1/base link", bag)["cause"] is None
    assert asked(capsys, "/robot1/ödom -> /robot1/base link", bag)["cause"] is None


def test_transforms_of_ros_1_have_their_authority(tmp_path, capsys):
    header1 = STORE1.types["std_msgs/msg/Header"]
    with Writer1(tmp_path / "one.bag") as writer:
        lines = [
            writer.add_connection("/tf", "tf2_msgs/msg/TFMessage", typestore=STORE1, callerid=node)
            for node in ("/slam", "/ekf")
        ]
        for number in range(200):
            at = START_NS + number * 10**8
            line = lines[number % 2]
            parent = ("map", "odom")[number % 2]
            one = message(STORE1, [(parent, "base", at)], lambda stamp, frame: header1(0, stamp, frame))
            writer.write(line, at, STORE1.serialize_ros1(one, "tf2_msgs/msg/TFMessage"))
    answer = asked(capsys, "map->base", tmp_path / "one.bag")
    assert "base has 2 parents" in answer["cause"]["says"]
    assert answer["cause"]["evidence"] == ["said by /ekf, /slam"]


def test_frames_need_a_recording(capsys):
    assert main(["why", "map->base_link", "-q"]) == 2
    assert "expected a recording with /tf" in capsys.readouterr().err


@pytest.mark.skipif(not has_tf2(), reason="no tf2_py of ROS Noetic beside the system's Python")
def test_look_ups_of_a_recording_are_those_of_tf2(tmp_path):
    bag = open_bag(recording(tmp_path / "bag", [*WHOLE, ("world", "crane", every(3, 15), 1.0)], STATIC))
    transforms = list(transforms_of(bag))
    rng = random.Random(5)
    names = ["map", "odom", "base_link", "laser", "camera", "world", "crane"]
    asked = [
        (rng.choice(names), rng.choice(names), rng.choice([0, START_NS + rng.randrange(5 * 10**9, 21 * 10**9)]))
        for _ in range(2000)
    ]
    (theirs,) = truths([(transforms, asked)])
    ours = mine(transforms, asked)
    assert len(transforms) == 1247
    differs = [one for one in zip(asked, ours, theirs, strict=True) if not alike(one[1], one[2])]
    assert not differs, differs[:5]
