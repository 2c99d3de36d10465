"""Bags written by ROS itself, whose chunks and definitions lie as its own recorder lays them."""

import json
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from roslens.live.adapters.bag.open_bag import open_bag

PYTHON = "/usr/bin/python3"
WRITE = """
import json, sys
import genpy, rosbag
from geometry_msgs.msg import PoseStamped
from std_msgs.msg import String
path, compression = sys.argv[1:]
rows = []
with rosbag.Bag(path, "w", compression=compression, chunk_threshold=2000) as bag:
    for number in range(300):
        time = genpy.Time(1600000000 + number // 10, (number * 37 % 10) * 100000000)
        if number % 3 or number < 20:
            message, topic = PoseStamped(), "/pose"
            message.header.stamp = time - genpy.Duration(0, 5000000)
            message.pose.position.x = number
        else:
            message, topic = String("x" * number), "/text"
        bag.write(topic, message, time)
with rosbag.Bag(path) as bag:
    for topic, message, time, header in bag.read_messages(return_connection_header=True, raw=True):
        rows.append((topic, time.to_nsec(), len(message[1]), header.get("callerid", "")))
print(json.dumps(rows))
"""


def rosbag_is_there():
    if not Path(PYTHON).exists():
        return False
    return (
        subprocess.run([PYTHON, "-c", "import rosbag, geometry_msgs"], capture_output=True, check=False).returncode == 0
    )


pytestmark = pytest.mark.real


@pytest.fixture(scope="module", autouse=True)
def _rosbag():
    if not rosbag_is_there():
        pytest.skip("Debian's python3-rosbag is not installed")


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
@pytest.mark.parametrize("closed", [True, False])
def test_a_bag_of_ros_is_read_as_ros_reads_it(tmp_path, compression, closed):
    path = tmp_path / "ros.bag"
    command = [PYTHON, "-c", WRITE, str(path), compression]
    rows = json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    if not closed:
        content = path.read_bytes()
        at = content.index(b"index_pos=") + 10
        index_at = int.from_bytes(content[at : at + 8], "little")
        path.write_bytes(content[:at] + bytes(8) + content[at + 8 : index_at])
    bag = open_bag(path)
    assert {topic.name: topic.count for topic in bag.topics} == Counter(row[0] for row in rows)
    for topic in ("/pose", "/text"):
        assert bag.times(topic).tolist() == sorted(row[1] for row in rows if row[0] == topic)
    tallies = [tally for _, step in bag.tallies(1.0, ["/pose"]) for tally in step]
    for topic in ("/pose", "/text"):
        assert sum(tally.bytes for tally in tallies if tally.topic == topic) == sum(
            row[2] for row in rows if row[0] == topic
        )
    ages = [tally.age for tally in tallies if tally.topic == "/pose" and tally.count]
    assert all(age.mean == pytest.approx(0.005) for age in ages)
    xs = [values["pose.position.x"] for _, _, values in bag.fields({"/pose": ["pose.position.x"]})]
    assert sorted(xs) == [float(number) for number in range(300) if number % 3 or number < 20]
    assert bool(bag.failures) is not closed
