import json
import os
import socket
import subprocess
import sys
import threading
import xmlrpc.server
from pathlib import Path

import pytest
from ros2_domain import own_domain

from roslens.live.observe.parameter_source import ros1_parameter, ros2_parameter, split_name
from roslens.model.errors import UsageError

WHEELS = Path(__file__).parents[2] / "build" / "ros2" / "bin" / "python"


@pytest.fixture
def master():
    server = xmlrpc.server.SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
    tree = {"/ref": [{"topic": "/scan"}]}
    server.register_function(
        lambda caller, key: [1, "", tree[key]] if key in tree else [-1, f"Parameter [{key}] is not set", 0], "getParam"
    )
    threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}/"
    server.shutdown()
    server.server_close()


def test_a_parameter_of_ros1(master):
    value, where = ros1_parameter("/ref", master)
    assert value == [{"topic": "/scan"}]
    assert where == f"the parameter server at {master}"


def test_what_is_missing_is_said(master):
    with pytest.raises(UsageError, match=r"no parameter '/other'.*rosparam"):
        ros1_parameter("/other", master)
    with socket.create_server(("127.0.0.1", 0)) as closed:
        port = closed.getsockname()[1]
    with pytest.raises(UsageError, match=r"no ROS master.*refuses connections.*roscore"):
        ros1_parameter("/ref", f"http://127.0.0.1:{port}/")


@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("/roslens/reference", ("/roslens", "reference")),
        ("/a/b/reference.arm", ("/a/b", "reference.arm")),
        ("/a:qos/./x", ("/a", "qos/./x")),
    ],
)
def test_a_name_is_node_and_parameter(name, parts):
    assert split_name(name) == parts


@pytest.mark.parametrize("name", ["/reference", "reference", "/a/", "/a:", ":b", ""])
def test_other_names_are_refused(name):
    with pytest.raises(UsageError, match="/node/parameter"):
        split_name(name)


NODE = """
import json, rclpy, sys
rclpy.init()
node = rclpy.create_node('roslens', namespace='/demo')
for name, value in json.loads(sys.argv[1]).items():
    node.declare_parameter(name, value)
rclpy.spin(node)
"""


@pytest.mark.real
def test_parameters_of_a_node(tmp_path):
    python = os.environ.get("ROSLENS_ROS2_PYTHON") or str(WHEELS)
    if not Path(python).exists():
        pytest.skip("no Python with rclpy")
    environment = {
        **os.environ,
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DOMAIN_ID": own_domain(),
        "ROS_LOG_DIR": str(tmp_path),
    }
    values = {"reference.arm": ["a: 1", "b: 2"], "reference.key": "c: 3", "rate": 7}
    node = subprocess.Popen([python, "-c", NODE, json.dumps(values)], env=environment, stderr=subprocess.DEVNULL)
    try:
        found, where = ros2_parameter("/demo/roslens/reference", python, None, environment)
        assert found == {"reference.arm": ["a: 1", "b: 2"], "reference.key": "c: 3"}
        assert where == "node /demo/roslens"
        with pytest.raises(UsageError, match=r"node /demo/roslens has no parameter 'other'"):
            ros2_parameter("/demo/roslens/other", python, None, environment)
        with pytest.raises(UsageError, match=r"no node /demo/nobody answers in 5 s"):
            ros2_parameter("/demo/nobody/reference", python, None, environment)
    finally:
        node.kill()
        node.wait()


def test_without_rclpy_that_is_said():
    with pytest.raises(UsageError, match="no Python with rclpy"):
        ros2_parameter("/a/b", sys.executable + "-none", None, os.environ)
