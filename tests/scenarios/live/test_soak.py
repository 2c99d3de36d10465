"""Each process of a watch for half an hour, on real ROS: its memory stays level.

`tests/live/test_soak.py` does the same to their insides in seconds.
"""

import contextlib
import os
import shutil
import socket
import subprocess
import sys
import time
from contextlib import ExitStack
from pathlib import Path

import pytest
from ros2_domain import own_domain

from roslens.live.inside import slots
from roslens.live.inside.environment import environment

pytestmark = [pytest.mark.real, pytest.mark.slow, pytest.mark.nightly]

ROOT = Path(__file__).parents[3]
WHEELS = ROOT / "build" / "ros2" / "bin" / "python"
SOAK_S = float(os.environ.get("ROSLENS_SOAK_S", "1800"))
SETTLE_SHARE = 1 / 3
"""Before that, what is seen for the first time is learnt."""
MOST_BYTES_A_SECOND = 2000
"""What a process may grow by from then on: 170 MB a day, a tenth of what a leak of one object a call was."""
SLACK_BYTES = 3_000_000
"""The allocator's pages, whose number is no measure of what is kept."""

TWINS = {"hook": "hook's twin", "ros2": "bystander"}
"""Of a process with parts of ROS inside, one with these parts alone: what rclpy and the middleware keep of each node
that ever was, some 8 kB, is nobody's here."""
BYSTANDER = "import rclpy; rclpy.init(); rclpy.spin(rclpy.create_node('bystander'))"
ROBOT = """
import rclpy
from rcl_interfaces.srv import GetParameters
from std_msgs.msg import Header
rclpy.init()
node = rclpy.create_node('robot')
out, relayed = node.create_publisher(Header, 'scan', 10), node.create_publisher(Header, 'relayed', 10)
node.create_subscription(Header, 'scan', relayed.publish, 10)
client = node.create_client(GetParameters, 'robot/get_parameters')
number = 0
def turn():
    global number, tool
    number += 1
    out.publish(Header(frame_id='x' * (number % 100)))
    client.call_async(GetParameters.Request(names=['use_sim_time']))
    if number % 50 == 0:
        name = f'tool_{number}'
        tool = rclpy.create_node(name)
        tool.create_publisher(Header, name, 1).publish(Header())
        tool.destroy_node()
node.create_timer(0.02, turn)
rclpy.spin(node)
"""
ROBOT1 = """
import rospy
from std_msgs.msg import Header
rospy.init_node('robot1')
out = rospy.Publisher('/old_scan', Header, queue_size=10)
rospy.Subscriber('/old_scan', Header, lambda message: None)
rate = rospy.Rate(50)
while not rospy.is_shutdown():
    out.publish(Header(frame_id='x'))
    rate.sleep()
"""


def stop(process):
    """End a process, which is asked to first: a node of rclpy does not always go when asked after half an hour."""
    process.terminate()
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(20)
    process.kill()
    process.wait()


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def children_of(pid):
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(child) for one in tasks for child in one.read_text().split()]


def resident(pid):
    """Bytes of memory that are the process's own."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith("RssAnon"))


def role_of(pid):
    """What a child of the monitor observes; empty of what is no observer."""
    words = Path(f"/proc/{pid}/cmdline").read_bytes().decode().replace("\0", " ")
    return next((role for role in ("ros1", "ros2") if f"adapters.{role}" in words), "")


@pytest.fixture
def processes(tmp_path):
    """The process ids of observers, agent, monitor, a hooked node, and of twins of what has ROS in it, by role."""
    key = tmp_path / "key"
    tool = [sys.executable, "-c", "from roslens.cli.main import main; import sys; sys.exit(main(sys.argv[1:]))"]
    subprocess.run([*tool, "agent", "--new-key", key], check=True)
    plain = {
        "PATH": os.environ["PATH"], "HOME": str(tmp_path), "ROS_DOMAIN_ID": own_domain(),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", slots.VARIABLE: str(tmp_path / "counters"),
    }  # fmt: skip
    port, master = free_port(), free_port()
    reference = tmp_path / "robot.yaml"
    reference.write_text("kind: reference\nname: r\nconstraints:\n  - {topic: /scan, rate: '>= 1 Hz'}\n")
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with ExitStack() as stack:

        def start(words, variables, **more):
            one = stack.enter_context(subprocess.Popen(words, env=variables, **{**quiet, **more}))
            stack.callback(stop, one)
            return one

        watch = [*tool, "watch", "--ros2", "--python", WHEELS, "--listen", f"127.0.0.1:{port}", "--key-file", key]
        watch += ["--reference", reference, "--history", tmp_path / "history.sqlite", "--for", f"{SOAK_S * 2 + 600}s"]
        if shutil.which("roscore"):
            ros1 = {**plain, "ROS_MASTER_URI": f"http://127.0.0.1:{master}", "ROS_IP": "127.0.0.1"}
            # A roscore that is killed leaves its master behind; one that is told to end takes it along.
            start(["roscore", "-p", str(master)], ros1)
            start(["/usr/bin/python3", "-c", "import time; time.sleep(5)\n" + ROBOT1], ros1)
            watch += ["--ros1", "--master", f"http://127.0.0.1:{master}"]
        node = start([WHEELS, "-c", ROBOT], {**plain, **environment(plain)})
        twin = start([WHEELS, "-c", ROBOT], {**plain, "ROS_DOMAIN_ID": own_domain()})
        bystander = start([WHEELS, "-c", BYSTANDER], plain)
        monitor = start(watch, plain)
        agent = start([*tool, "agent", f"127.0.0.1:{port}", "--key-file", key, "--name", "elsewhere"], plain)
        end, wanted = time.monotonic() + 60, 1 + bool(shutil.which("roscore"))
        while len(observers := {role: pid for pid in children_of(monitor.pid) if (role := role_of(pid))}) < wanted:
            assert time.monotonic() < end, observers
            time.sleep(0.2)
        twins = {TWINS["hook"]: twin.pid, TWINS["ros2"]: bystander.pid}
        yield {"hook": node.pid, "monitor": monitor.pid, "agent": agent.pid, **observers, **twins}


@pytest.mark.timeout(SOAK_S + 300)
def test_memory_stays_level(processes):
    time.sleep(SOAK_S * SETTLE_SHARE)
    before = {role: resident(pid) for role, pid in processes.items()}
    time.sleep(SOAK_S * (1 - SETTLE_SHARE))
    grown = {role: resident(pid) - before[role] for role, pid in processes.items()}
    most = MOST_BYTES_A_SECOND * SOAK_S * (1 - SETTLE_SHARE) + SLACK_BYTES
    own = {role: many - max(grown.get(TWINS.get(role, ""), 0), 0) for role, many in grown.items()}
    table = "\n".join(
        f"{role}: {before[role] / 1e6:.1f} {grown[role] / 1e6:+.2f} MB, own {own[role] / 1e6:+.2f}" for role in own
    )
    sys.stdout.write(table)
    assert [role for role in own.keys() - set(TWINS.values()) if own[role] >= most] == [], table
