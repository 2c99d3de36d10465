"""Starts the nodes of the demo robot with one fault in it, or none, until Ctrl-C.

    python3 examples/broken/robot.py [none|qos|name|domain|clock]

It starts what `ros2 launch demo_robot robot.launch.py` starts, and needs rclpy alone.
"""

import argparse
import os
import signal
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
NODES = ("lidar", "odometry", "planner")
FAULTS = {
    "none": {},
    # The planner requests each scan reliably, which the lidar does not offer.
    "qos": {"planner": ["-p", "reliable:=true"]},
    # A typing error in a remapping: nobody reads the commands.
    "name": {"planner": ["-r", "cmd_vel:=cmd_vle"]},
    # The lidar was started in a terminal with another ROS_DOMAIN_ID.
    "domain": {"lidar": []},
    # Odometry waits for the clock of a simulator that does not run.
    "clock": {"odometry": ["-p", "use_sim_time:=true"]},
}


def environment_of(node, fault, other_domain):
    """Return the environment of a node; sources are used as they are, without a build."""
    path = [str(HERE / "src/demo_robot"), *filter(None, [os.environ.get("PYTHONPATH")])]
    found = dict(os.environ, PYTHONPATH=os.pathsep.join(path))
    if fault == "domain" and node == "lidar":
        found["ROS_DOMAIN_ID"] = str(other_domain)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("fault", nargs="?", default="none", choices=FAULTS)
    parser.add_argument("--other-domain", type=int, metavar="N", default=int(os.environ.get("ROS_DOMAIN_ID") or 0) + 1)
    options = parser.parse_args()
    fault = options.fault
    nodes = []
    for name in NODES:
        words = FAULTS[fault].get(name, [])
        command = [sys.executable, "-m", f"demo_robot.{name}", "--ros-args", "-r", f"__node:={name}", *words]
        nodes.append(subprocess.Popen(command, env=environment_of(name, fault, options.other_domain)))
    print("lidar, odometry and planner run; Ctrl-C ends them", flush=True)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: None)
    signal.pause()
    for node in nodes:
        node.terminate()
    for node in nodes:
        node.wait()


if __name__ == "__main__":
    main()
