"""A reference that stands in parameters of a running system is what a watch of that system holds it against."""

import os
import shutil
import socket
import subprocess
from pathlib import Path

import pytest
from ros2_domain import own_domain
from running_node import running
from watched_until import watch_until

pytestmark = pytest.mark.real

WHEELS = Path(__file__).parents[3] / "build" / "ros2" / "bin" / "python"
PUT = """
import time
import rospy
while True:
    try:
        rospy.set_param('/roslens/reference', [{'topic': '/never', 'expected': 'always', 'grace': '1 s'}])
        break
    except OSError:
        time.sleep(0.2)
"""
HOLD = """
import rclpy
rclpy.init()
node = rclpy.create_node('roslens')
text = 'kind: reference\\nname: {}\\nconstraints:\\n  - {{topic: /{}, expected: always, grace: 1 s}}\\n'
node.declare_parameter('reference', [text.format('a', 'never'), text.format('b', 'ever')])
rclpy.spin(node)
"""


def absent(*names):
    """Whether all of these are said to be absent."""
    return lambda lines: (
        set(names) <= {one["entity"] for one in lines if one["is"] == "verdict" and one["state"] == "absent"}
    )


@pytest.mark.skipif(not shutil.which("roscore"), reason="roscore is not installed")
def test_constraints_on_the_parameter_server(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    master = f"http://127.0.0.1:{port}"
    environment = {**os.environ, "ROS_MASTER_URI": master, "ROS_IP": "127.0.0.1", "ROS_HOME": str(tmp_path)}
    words = ["--ros1", "--reference", "param:/roslens/reference"]
    missing = watch_until(lambda _: False, words, environment)
    assert missing.code == 2
    assert f"no ROS master: {master} refuses connections" in missing.errors
    with running("roscore", "-p", str(port), environment=environment):
        subprocess.run(["/usr/bin/python3", "-c", PUT], env=environment, check=True, timeout=30)
        ended = watch_until(absent("topic:/never"), words, environment)
    assert ended.code == 1, ended
    assert absent("topic:/never")(ended.lines)


def test_documents_in_a_parameter_of_a_node(tmp_path):
    python = os.environ.get("ROSLENS_ROS2_PYTHON") or str(WHEELS)
    if not Path(python).exists():
        pytest.skip("no Python with rclpy: `make parts` makes build/ros2, or name one in $ROSLENS_ROS2_PYTHON")
    environment = {
        **os.environ,
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DOMAIN_ID": own_domain(),
        "ROS_LOG_DIR": str(tmp_path),
        "ROSLENS_ROS2_PYTHON": python,
    }
    with running(python, "-c", HOLD, environment=environment):
        both = absent("topic:/never", "topic:/ever")
        ended = watch_until(both, ["--ros2", "--reference", "param:/roslens/reference"], environment)
    assert ended.code == 1, ended
    assert both(ended.lines)
