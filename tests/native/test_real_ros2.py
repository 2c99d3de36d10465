"""The library in real nodes: what it counts is what the nodes counted."""

import json
import os
import subprocess
from pathlib import Path

import pytest
from native.series import series
from ros2_domain import own_domain

from roslens.live.inside import slots
from roslens.live.inside.counters import CounterReader, joined
from roslens.live.inside.slots import ANSWERED, ASKED, HEARD, PUBLISHED, REPLIED, REQUESTED, TAKEN
from roslens.live.inside.snapshot import snapshot

pytestmark = pytest.mark.real

ROOT = Path(__file__).parents[2]
PAIR = Path(__file__).with_name("ros2_pair.py")
MESSAGES, CALLS = 400, 5


@pytest.fixture(scope="module")
def python():
    """A Python with rclpy."""
    found = os.environ.get("ROSLENS_ROS2_PYTHON") or str(ROOT / "build" / "ros2" / "bin" / "python")
    plain = {"PATH": os.environ["PATH"]}
    if not Path(found).exists():
        pytest.skip(f"no {found}; run `make parts`, or name a Python with rclpy in ROSLENS_ROS2_PYTHON")
    tried = subprocess.run([found, "-c", "import rclpy, std_msgs.msg"], env=plain, capture_output=True, text=True)
    if tried.returncode:
        pytest.skip(f"{found} has no rclpy: {tried.stderr.strip().splitlines()[-1]}")
    return found


class Pair:
    """Talker and listener, until both have counted; then what the counters say, while both still run."""

    def __init__(self, python, counters, environment, messages=MESSAGES, calls=CALLS):
        self.counters = counters
        plain = {
            "PATH": os.environ["PATH"],
            "HOME": os.environ.get("HOME", "/"),
            "ROS_DOMAIN_ID": own_domain(),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            slots.VARIABLE: str(counters),
            **environment,
        }
        self.nodes = {
            role: subprocess.Popen(
                [python, PAIR, role, str(messages), str(calls)],
                env=plain, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            )
            for role in ("listener", "talker")
        }  # fmt: skip
        self.reported = {}
        self.counted_by = {}

    def __enter__(self):
        for role, node in self.nodes.items():
            line = node.stdout.readline()
            assert line, node.stderr.read()
            self.reported[role] = json.loads(line)
        return self

    def __exit__(self, *_):
        for node in self.nodes.values():
            try:
                node.communicate("", timeout=30)
            finally:
                node.kill()

    def slots(self):
        """The slots of both by kind, topic and node; topics every node has are left out."""
        found = {}
        for path in self.counters.glob(f"*{slots.SUFFIX}"):
            raw = path.read_bytes()
            (used,) = slots.struct.unpack_from("=I", raw, slots.USED_AT)
            for number in range(used):
                at = slots.HEADER_BYTES + number * slots.SLOT_BYTES
                one = snapshot(memoryview(raw)[at : at + slots.SLOT_BYTES])
                self.counted_by[one.kind] = slots.HEADER.unpack_from(raw)[10].split(b":")[0]
                if one.kind != ANSWERED and one.topic in ("/typed", "/raw", "/talker/get_parameters"):
                    assert (one.kind, one.topic, one.node) not in found
                    found[one.kind, one.topic, one.node] = one
        return found


def test_structs_are_laid_out_as_declared(build, python):
    includes = Path(python).parents[1] / "include"
    if not (includes / "rmw").is_dir():
        pytest.skip(f"no headers of ROS 2 in {includes}")
    folders = [f"-I{folder}" for folder in sorted(includes.iterdir()) if folder.is_dir()]
    source = ROOT / "native" / "tests" / "rmw_abi.c"
    checked = [*build.compiler(), "-std=c11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *folders, str(source)]
    done = subprocess.run(checked, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_counts_are_those_of_the_nodes(built, python, tmp_path):
    reader = CounterReader(str(tmp_path))
    reader.read(0.0)
    with Pair(python, tmp_path, {"LD_PRELOAD": str(built.hook)}) as pair:
        found = pair.slots()
        tallies = joined(reader.read(4e9), lambda gid: "/talker", "here")
    talker, listener = pair.reported["talker"], pair.reported["listener"]
    assert {key: one.messages for key, one in found.items()} == {
        (PUBLISHED, "/typed", "/talker"): talker["typed"],
        (PUBLISHED, "/raw", "/talker"): talker["raw"],
        (TAKEN, "/typed", "/listener"): listener["typed"],
        (TAKEN, "/raw", "/listener"): listener["raw"],
        (REQUESTED, "/talker/get_parameters", "/listener"): listener["answers"],
        (HEARD, "/talker/get_parameters", "/listener"): listener["answers"],
        (ASKED, "/talker/get_parameters", "/talker"): listener["answers"],
        (REPLIED, "/talker/get_parameters", "/talker"): listener["answers"],
    }
    assert (listener["typed"], listener["raw"], listener["answers"]) == (MESSAGES, MESSAGES // 2, CALLS)
    for topic in ("/typed", "/raw"):
        sent, taken = found[PUBLISHED, topic, "/talker"], found[TAKEN, topic, "/listener"]
        assert sent.gid == taken.gid != bytes(24)
        assert (taken.lost, taken.pending) == (0, 0)
        count, total, _ = series(taken)[1]
        assert count == taken.messages
        assert 1e-6 < total / count < 0.1
    assert found[TAKEN, "/raw", "/listener"].size == listener["size"]
    assert found[PUBLISHED, "/raw", "/talker"].size == talker["size"]  # less than was taken: DDS fills up to four bytes
    for kind, node in ((HEARD, "/listener"), (REPLIED, "/talker")):
        count, total, _ = series(found[kind, "/talker/get_parameters", node])[3]
        assert count == CALLS
        assert 1e-6 < total / count < 5.0
    by_ends = {(one.topic, one.publisher, one.subscriber): one for one in tallies}
    assert by_ends["/typed", "/talker", "/listener"].count == MESSAGES
    assert by_ends["/typed", "/talker", "/listener"].lost == 0
    assert not any("get_parameters" in one.topic for one in tallies)
    assert list(tmp_path.glob(f"*{slots.SUFFIX}")) == []


def test_beside_the_library_the_hook_in_python_counts_nothing_and_nothing_is_missing(built, python, tmp_path):
    from roslens.live.inside.environment import PATH

    with Pair(python, tmp_path, {"LD_PRELOAD": str(built.hook), "PYTHONPATH": PATH}) as pair:
        files = len(list(tmp_path.glob(f"*{slots.SUFFIX}")))
        found = pair.slots()
    assert files == 2
    assert {key[:2]: one.messages for key, one in found.items()} == {
        (PUBLISHED, "/typed"): MESSAGES,
        (PUBLISHED, "/raw"): MESSAGES // 2,
        (TAKEN, "/typed"): MESSAGES,
        (TAKEN, "/raw"): MESSAGES // 2,
        **{(kind, "/talker/get_parameters"): CALLS for kind in (REQUESTED, HEARD, ASKED, REPLIED)},
    }
    assert (pair.counted_by[TAKEN], pair.counted_by[HEARD]) == (b"preload", b"preload")
    talker = pair.reported["talker"]
    sent, taken = found[PUBLISHED, "/typed", "/talker"], found[TAKEN, "/typed", "/listener"]
    assert sent.size == taken.size == talker["typed_size"]
    assert series(taken)[2][0] == 0  # it is a header, and has none


RELAY = """
import sys, time, rclpy
from rclpy.serialization import serialize_message
from sensor_msgs.msg import LaserScan
rclpy.init()
node = rclpy.create_node('relay')
out, first = (node.create_publisher(LaserScan, topic, 10) for topic in ('scan_out', 'scan'))
sizes = []
def relay(message):
    sizes.append(len(serialize_message(message)))
    time.sleep(0.002)
    out.publish(message)
node.create_subscription(LaserScan, 'scan', relay, 10)
timed = node.create_publisher(LaserScan, 'timed', 10)
node.create_timer(0.01, lambda: timed.publish(LaserScan()))
while len(sizes) < 30:
    scan = LaserScan(ranges=[1.0] * len(sizes))
    scan.header.frame_id = 'x' * (len(sizes) % 5)
    ahead = time.time_ns() - 1_000_000_000
    scan.header.stamp.sec, scan.header.stamp.nanosec = divmod(ahead, 1_000_000_000)
    first.publish(scan)
    known, end = len(sizes), time.monotonic() + 0.5
    while len(sizes) == known and time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.1)
print(sum(sizes), len(sizes), flush=True)
sys.stdin.read()
"""


def test_a_relay_in_python_has_sizes_ages_and_processing_times(built, python, tmp_path):
    from roslens.live.inside.environment import PATH

    variables = {
        "PATH": os.environ["PATH"], "HOME": os.environ.get("HOME", "/"), "ROS_DOMAIN_ID": own_domain(),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", slots.VARIABLE: str(tmp_path), "LD_PRELOAD": str(built.hook),
        "PYTHONPATH": PATH,
    }  # fmt: skip
    with subprocess.Popen(
        [python, "-c", RELAY], env=variables, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as node:
        size, count = map(int, node.stdout.readline().split())
        (path,) = tmp_path.glob(f"*{slots.SUFFIX}")
        raw = path.read_bytes()
        node.communicate("")
    (used,) = slots.struct.unpack_from("=I", raw, slots.USED_AT)
    starts = [slots.HEADER_BYTES + number * slots.SLOT_BYTES for number in range(used)]
    read = [snapshot(memoryview(raw)[at : at + slots.SLOT_BYTES]) for at in starts]
    found = {(one.kind, one.topic, one.other): one for one in read}
    taken, sent = found[TAKEN, "/scan", ""], found[PUBLISHED, "/scan_out", ""]
    assert (taken.messages, sent.messages, sent.size) == (count, count, size)
    assert taken.size == size
    ages, total, _ = series(taken)[2]
    assert ages == count
    assert 1.0 < total / ages < 2.0
    answers, total, _ = series(found[ANSWERED, "/scan_out", "/scan"])[3]
    assert answers == count
    assert 0.002 <= total / answers < 0.5
    assert (ANSWERED, "/timed", "/scan") not in found
