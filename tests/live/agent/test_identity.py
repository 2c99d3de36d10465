import os
import subprocess

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.agent.identity import identities, own_addresses, own_identities
from testbed import robot_ros2

PROGRAM = """
import rclpy
rclpy.init(domain_id=61)
node = rclpy.create_node("identity")
while not node.get_publishers_info_by_topic("/parameter_events"):
    rclpy.spin_once(node, timeout_sec=0.05)
print(bytes(node.get_publishers_info_by_topic("/parameter_events")[0].endpoint_gid).hex())
"""


def test_bits_that_were_seen_in_identifiers():
    assert identities([bytes([192, 0, 2, 2])], "vm")[0] == "78fd"


def test_a_host_without_an_address_has_none():
    assert identities([], "base") == ()


@given(st.lists(st.binary(min_size=4, max_size=4), min_size=1, max_size=4), st.text())
def test_bits_are_four_digits(addresses, name):
    assert all(len(bytes.fromhex(one)) == 2 for one in identities(addresses, name))


def test_loopback_is_no_address():
    assert not [address for address in own_addresses() if address[0] == 127]


@pytest.mark.real
def test_a_node_has_the_bits_of_its_host():
    if reason := robot_ros2.why_not():
        pytest.skip(reason)
    if not own_addresses():
        pytest.skip("this host has no address but loopback")
    plain = {"PATH": os.environ["PATH"], "HOME": os.environ.get("HOME", "/")}
    ran = subprocess.run(
        [robot_ros2.python(), "-c", PROGRAM], env=plain, capture_output=True, text=True, timeout=60, check=True
    )
    assert ran.stdout[4:8] in own_identities()
