"""An observer beyond the participants that the middleware announces to still meets the nodes beyond."""

import os
import socket
import subprocess
import time
from contextlib import ExitStack
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from ros2_domain import own_domain

from roslens.live.adapters.child import Child, clean_environment, ros2_command
from roslens.live.adapters.ros2.far_peers import KNOWN, far_peers, profile, wanted
from roslens.model.wire import Frame
from testbed import robot_ros2

LOCAL = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


@pytest.mark.parametrize(
    ("environment", "expected"),
    [
        ({}, False),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, False),
        (LOCAL, True),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "localhost"}, True),
        (LOCAL | {"ROS_DISTRO": "humble"}, False),
        (LOCAL | {"ROS_DISTRO": "jazzy"}, True),
        (LOCAL | {"RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}, False),
        (LOCAL | {"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}, True),
        (LOCAL | {"FASTDDS_DEFAULT_PROFILES_FILE": "mine.xml"}, False),
        (LOCAL | {"FASTRTPS_DEFAULT_PROFILES_FILE": "mine.xml"}, False),
    ],
)
def test_only_where_ports_are_all_that_is_known(environment, expected, tmp_path):
    assert wanted(environment, tmp_path) is expected


def test_a_profile_of_the_folder_stays_alone(tmp_path):
    (tmp_path / "DEFAULT_FASTDDS_PROFILES.xml").touch()
    assert not wanted(LOCAL, tmp_path)


def test_ports_follow_those_that_are_known_up_to_the_next_domain():
    written = ET.fromstring(profile(41).encode())
    ports = [int(one.text) for one in written.iter() if one.tag.endswith("port")]
    assert ports[0] == 7400 + 250 * 41 + 10 + 2 * KNOWN
    assert ports[-1] < 7400 + 250 * 42
    assert ports == sorted(set(ports))


def test_ports_that_do_not_exist_are_left_out():
    assert "<port>65536" not in profile(232)


@pytest.mark.parametrize(
    ("distribution", "variable"),
    [("", "FASTDDS_DEFAULT_PROFILES_FILE"), ("jazzy", "FASTRTPS_DEFAULT_PROFILES_FILE")],
)
def test_the_profile_is_there_while_it_is_read_and_gone_afterwards(distribution, variable):
    environment = LOCAL | {"ROS_DISTRO": distribution, "ROS_DOMAIN_ID": "7"}
    before = dict(environment)
    with far_peers(environment, None):
        path = Path(environment[variable])
        assert path.read_text() == profile(7)
    assert environment == before
    assert not path.exists()
    with far_peers(environment, 9):
        assert Path(environment[variable]).read_text() == profile(9)


NODE = "import rclpy, sys; rclpy.init(); rclpy.spin(rclpy.create_node(sys.argv[1]))"


@pytest.mark.real
def test_nodes_beyond_are_met(tmp_path):
    if reason := robot_ros2.why_not():
        pytest.skip(reason)
    python, domain = robot_ros2.python(), own_domain()
    base = clean_environment(os.environ) | LOCAL
    base |= {"ROS_DOMAIN_ID": domain, "ROS_LOG_DIR": str(tmp_path), "ROSLENS_COUNTERS": str(tmp_path / "counters")}
    with ExitStack() as stack:
        for number in range(KNOWN + 1):
            for port in (10, 11):
                held = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
                held.bind(("0.0.0.0", 7400 + 250 * int(domain) + port + 2 * number))
        for name in ("one", "two"):
            node = stack.enter_context(
                subprocess.Popen(
                    [python, "-c", NODE, name], env=base, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
                )
            )
            stack.callback(node.kill)
        child = Child("ros2", ros2_command(python, []), base)
        stack.callback(child.close)
        seen = set()
        while not {"/one", "/two"} <= seen:  # how long that may take is the test's own limit
            for frame in child.poll(time.monotonic()):
                assert isinstance(frame, Frame), frame
                seen |= {node.name for node in frame.graph.nodes} if frame.graph else set()
            time.sleep(0.01)
