"""What counting costs a rospy subscriber: without, with rospy's own logger, with the light one.

    python benchmarks/ros1_statistics.py [--rate 1000] [--seconds 10] [--rounds 3]

Needs Debian's ROS 1 (`make parts`). A talker publishes PointStamped messages, which have headers, at a fixed rate;
three subscribers receive them side by side, so that a drifting machine drifts for all. The figure is the CPU time that
each subscriber's process used, by the messages it received.
"""

from __future__ import annotations

import argparse
import os
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import xmlrpc.client
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

PYTHON = "/usr/bin/python3"
PATH = str(Path(__file__).parents[1] / "src" / "roslens" / "live" / "inside" / "path")

TALKER = """
import rospy, sys
from geometry_msgs.msg import PointStamped
rospy.init_node("talker")
publisher = rospy.Publisher("/point", PointStamped, queue_size=100)
rate = rospy.Rate(float(sys.argv[1]))
message = PointStamped()
while not rospy.is_shutdown():
    message.header.stamp = rospy.Time.now()
    publisher.publish(message)
    rate.sleep()
"""
LISTENER = """
import rospy, sys, time
from geometry_msgs.msg import PointStamped
rospy.init_node(sys.argv[1])
count = [0]
def receive(message):
    count[0] += 1
rospy.Subscriber("/point", PointStamped, receive)
while count[0] < 100:
    time.sleep(0.1)
for _ in range(int(sys.argv[3])):
    begun, cpu = count[0], time.process_time()
    time.sleep(float(sys.argv[2]))
    print((time.process_time() - cpu) / max(count[0] - begun, 1), flush=True)
"""


def started(environment: Mapping[str, str], *command: str, read: bool = False) -> subprocess.Popen[str]:
    """Start a program whose output is read or dropped."""
    output = subprocess.PIPE if read else subprocess.DEVNULL
    return subprocess.Popen(command, env=environment, stdout=output, stderr=subprocess.DEVNULL, text=True)


def main() -> int:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--rate", type=float, default=1000)
    arguments.add_argument("--seconds", type=float, default=10)
    arguments.add_argument("--rounds", type=int, default=3)
    options = arguments.parse_args()
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    with tempfile.TemporaryDirectory(prefix="roslens-bench-") as scratch:
        uri = f"http://127.0.0.1:{port}"
        environment = {
            **os.environ, "ROS_MASTER_URI": uri, "ROS_IP": "127.0.0.1", "ROS_HOME": scratch, "ROS_LOG_DIR": scratch,
        }  # fmt: skip
        environment.pop("PYTHONPATH", None)
        running = [started(environment, "roscore", "-p", str(port))]
        try:
            costs = measured(uri, environment, Path(scratch), running, options)
        finally:
            for process in reversed(running):
                process.terminate()
            for process in running:
                process.wait()
    base = statistics.median(costs["none"])
    for name, values in costs.items():
        value = statistics.median(values)
        print(f"{name:8} {value * 1e6:6.1f} us/message   {(value - base) * 1e6:+6.1f} us")
    return 0


def measured(
    uri: str,
    environment: dict[str, str],
    scratch: Path,
    running: list[subprocess.Popen[str]],
    options: argparse.Namespace,
) -> dict[str, list[float]]:
    """Start the nodes and return CPU seconds a message by how they count."""
    master = xmlrpc.client.ServerProxy(uri)
    switch(master, False)
    for name, text in (("talker.py", TALKER), ("listener.py", LISTENER)):
        (scratch / name).write_text(text)
    running.append(started(environment, PYTHON, str(scratch / "talker.py"), str(options.rate)))
    rest = ["listener.py", str(options.seconds), str(options.rounds)]

    def listener(name: str, **more: str) -> subprocess.Popen[str]:
        words = [PYTHON, str(scratch / rest[0]), name, *rest[1:]]
        running.append(started({**environment, **more}, *words, read=True))
        return running[-1]

    nodes = {"none": listener("none"), "light": listener("light", PYTHONPATH=PATH)}
    for node in ("/none", "/light"):
        wait_for(master, node)
    switch(master, True)
    nodes["rospy"] = listener("rospy")
    found = {}
    for name, process in nodes.items():
        lines, _ = process.communicate(timeout=60 + 3 * options.seconds * options.rounds)
        found[name] = [float(line) for line in lines.split()]
    return found


def switch(master: xmlrpc.client.ServerProxy, on: bool) -> None:
    """Set the parameter that makes rospy count, once the master answers."""
    for _ in range(200):
        with suppress(OSError):
            master.setParam("/benchmark", "/enable_statistics", on)
            return
        time.sleep(0.1)
    raise SystemExit("no master after 20 s")


def wait_for(master: xmlrpc.client.ServerProxy, node: str) -> None:
    """Wait until a node has subscribed."""
    for _ in range(200):
        answer = master.getSystemState("/benchmark")
        if isinstance(answer, list) and any(node in nodes for topic, nodes in answer[2][1] if topic == "/point"):
            return
        time.sleep(0.1)
    raise SystemExit(f"{node} did not subscribe within 20 s")


if __name__ == "__main__":
    sys.exit(main())
