"""roslens_msgs is built for real: by genpy, by catkin, and by the generators of rosidl."""

import json
import os
import shutil
import subprocess
from pathlib import Path
from xml.etree.ElementTree import parse

import pytest

from roslens.live.adapters.child import clean_environment
from roslens.live.adapters.ros1.publishing import MonitorPublisher
from roslens.live.adapters.ros1.wire.definition import known_definitions
from roslens.model.acting.outgoing import (
    VERSION,
    ConnectionStatistics,
    Outgoing,
    RatedSignal,
    RatedSignals,
    encode_outgoing,
)

PACKAGE = Path(__file__).parents[2] / "ros" / "roslens_msgs"
RATED = "roslens_msgs/RatedSignals"
SIGNAL = RatedSignal(
    "topic", "/scän", "r.rate", "rate", "Hz", 1.5, 25.0, float("inf"), 3, 9.25, 2, "host:b", "5 s", "x"
)
FRAME = RatedSignals("m", True, 1, 2, (SIGNAL,), (ConnectionStatistics("/scan", "/a", "/b", 1.0, 2.0, drops=3.0),))
TOLD = """
print(json.dumps([message.monitor, message.complete, message.part, message.parts,
    [[getattr(one, name) for name in json.loads(sys.argv[1])] for one in message.signals],
    [[getattr(one, name) for name in json.loads(sys.argv[2])] for one in message.connections]]))
"""
FIELDS = [json.dumps(kind.__struct_fields__) for kind in (RatedSignal, ConnectionStatistics)]
EXPECTED = json.loads(
    json.dumps(
        ["m", True, 1, 2, [[getattr(SIGNAL, name) for name in SIGNAL.__struct_fields__]],
         [[getattr(one, name) for name in one.__struct_fields__] for one in FRAME.connections]]
    ).replace("NaN", '"NaN"')
)  # fmt: skip

real = pytest.mark.real


def reported(text):
    return json.loads(text.replace("NaN", '"NaN"'))


def test_the_package_is_one_of_both_generations():
    package = parse(PACKAGE / "package.xml").getroot()
    assert package.get("format") == "3"
    assert {(one.get("condition"), one.text) for one in package.iter("build_type")} == {
        ("$ROS_VERSION == 1", "catkin"), ("$ROS_VERSION == 2", "ament_cmake"),
    }  # fmt: skip
    listed = (PACKAGE / "CMakeLists.txt").read_text()
    assert all(file.name in listed for file in PACKAGE.glob("msg/*.msg"))


@real
def test_genpy_reads_what_we_serialise_and_has_our_sums(messages1):
    class Server:
        def publish(self, topic, body):
            self.body = body

        def close(self):
            pass

    saying = MonitorPublisher("127.0.0.1", "127.0.0.1", "/roslens", diagnostics=False, rated="/rated")
    saying.close()
    saying._server = server = Server()
    saying.publish(Outgoing(VERSION, 5.5, rated=FRAME))
    code = (
        "import json, sys\nfrom roslens_msgs.msg import RatedSignals, RatedSignal, ConnectionStatistics\n"
        "message = RatedSignals()\nmessage.deserialize(sys.stdin.buffer.read())\n"
        "print(RatedSignals._md5sum, RatedSignal._md5sum, ConnectionStatistics._md5sum)\n"
        "print(message.header.stamp.to_sec())\n" + TOLD
    )
    ended = subprocess.run(
        ["/usr/bin/python3", "-c", code, *FIELDS], input=server.body, capture_output=True, check=True,
        env={**os.environ, "PYTHONPATH": str(messages1)},
    )  # fmt: skip
    sums, stamp, values = ended.stdout.decode().splitlines()
    definitions = known_definitions()
    names = ("RatedSignals", "RatedSignal", "ConnectionStatistics")
    assert sums.split() == [definitions.md5(f"roslens_msgs/{name}") for name in names]
    assert (float(stamp), reported(values)) == (5.5, EXPECTED)


@real
@pytest.mark.parametrize("variables", [{}, {"ROS_VERSION": "1"}], ids=["as Debian does", "as rosdep's ROS 1 does"])
def test_catkin_builds_it(tmp_path, variables):
    for part in ("cmake", "catkin_make", "g++"):
        if not shutil.which(part):
            pytest.skip(f"{part} is not installed")
    environment = {name: value for name, value in os.environ.items() if name not in ("ROS_VERSION", "PYTHONPATH")}
    build = tmp_path / "build"
    words = ["-DPYTHON_EXECUTABLE=/usr/bin/python3", f"-DCATKIN_DEVEL_PREFIX={tmp_path / 'devel'}"]
    for command in (["cmake", "-S", str(PACKAGE), "-B", str(build), *words], ["cmake", "--build", str(build)]):
        done = subprocess.run(command, env={**environment, **variables}, capture_output=True, text=True, check=False)
        assert not done.returncode, done.stdout + done.stderr
    assert (tmp_path / "devel" / "include" / "roslens_msgs" / "RatedSignals.h").exists()
    (python,) = (tmp_path / "devel").rglob("_RatedSignals.py")
    assert known_definitions().md5(RATED) in python.read_text()


@real
def test_rosidl_makes_messages_that_go_there_and_back(ros2_python, messages2):
    code = (
        "import json, sys\nfrom rclpy.serialization import deserialize_message, serialize_message\n"
        "from roslens.live.adapters.ros2.publishing import rated_signals\n"
        "from roslens.model.acting.outgoing import OutgoingReader\n"
        "from roslens_msgs.msg import RatedSignal, RatedSignals\n"
        "(frame,) = OutgoingReader().feed(sys.stdin.buffer.read())\n"
        "message = deserialize_message(serialize_message(rated_signals(frame.time, frame.rated)), RatedSignals)\n"
        "print(message.header.stamp.sec, message.header.stamp.nanosec, RatedSignal.STATE_ABSENT)\n" + TOLD
    )
    source = str(Path(__file__).parents[2] / "src")
    ended = subprocess.run(
        [ros2_python, "-c", code, *FIELDS], input=encode_outgoing(Outgoing(VERSION, 5.5, rated=FRAME)),
        env={**clean_environment(os.environ), "PYTHONPATH": os.pathsep.join([str(messages2), source])},
        capture_output=True, check=False,
    )  # fmt: skip
    assert not ended.returncode, ended.stderr.decode()
    stamp, told_values = ended.stdout.decode().splitlines()
    assert stamp == "5 500000000 5"
    assert reported(told_values) == EXPECTED
