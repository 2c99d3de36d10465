"""What a watch costs while a robot of ROS 2 runs: its monitor and its observer, in processor time and memory.

    python benchmarks/live_cost.py [SECONDS] [--nodes N] [--topics N] [--hz N]

Starts nodes through `roslens run`, which exchange messages in a ring: each node publishes its share of the topics and
subscribes to those of the next one. Once `roslens watch --ros2` has judged the rate of every topic, and 10 s later, it
is measured for so many seconds: the processor time of its processes as a share of that time, which does not depend on
who else uses the machine, and their resident memory at the beginning and at the end, which shows what grows.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]
ROSLENS = str(Path(sys.executable).with_name("roslens"))
PROCESSES = 4
WARM_S, LONGEST_S = 10.0, 240.0
TICKS = os.sysconf("SC_CLK_TCK")
PAGE = os.sysconf("SC_PAGE_SIZE")
NODES = """
import sys
import rclpy
from rclpy.executors import SingleThreadedExecutor
from std_msgs.msg import String

first, last, nodes, each = map(int, sys.argv[1:5])
hz = float(sys.argv[5])
rclpy.init()
executor = SingleThreadedExecutor()
for number in range(first, last):
    node = rclpy.create_node(f"node{number}")
    made = [node.create_publisher(String, f"/part{number}/topic{place}", 10) for place in range(each)]
    for place in range(each):
        node.create_subscription(String, f"/part{(number + 1) % nodes}/topic{place}", lambda _: None, 10)
    node.create_timer(1 / hz, lambda made=made: [one.publish(String(data="x")) for one in made])
    executor.add_node(node)
executor.spin()
"""
REFERENCE = "kind: reference\nname: cost\nconstraints:\n  - {{topic: '/part*/topic*', rate: {low}..{high} Hz}}\n"


def children(pid: int) -> list[int]:
    """Return a process and everything below it."""
    found = [pid]
    for task in Path(f"/proc/{pid}/task").iterdir():
        for child in (task / "children").read_text().split():
            found += children(int(child))
    return found


def used(pid: int) -> tuple[float, float]:
    """Return the seconds of processor time that a process has had, and its resident memory in MB."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS, int(fields[21]) * PAGE / 1e6


def judged(output: Path) -> set[str]:
    """Return the topics whose rate was judged."""
    lines = map(json.loads, output.read_text().rpartition("\n")[0].splitlines() if output.exists() else ())
    return {one["entity"] for one in lines if one["is"] == "verdict" and one["quantity"] == "rate"}


def main() -> int:
    """Measure and print a line for each process of the watch, and one for all of them."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("seconds", type=float, nargs="?", default=60.0)
    arguments.add_argument("--nodes", type=int, default=20)
    arguments.add_argument("--topics", type=int, default=200)
    arguments.add_argument("--hz", type=float, default=5.0)
    options = arguments.parse_args()
    python = os.environ.get("ROSLENS_ROS2_PYTHON") or str(ROOT / "build" / "ros2" / "bin" / "python")
    with tempfile.TemporaryDirectory(prefix="roslens-cost-", ignore_cleanup_errors=True) as folder:
        environment = {
            **os.environ, "ROS_DOMAIN_ID": "77", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROSLENS_ROS2_PYTHON": python, "ROSLENS_COUNTERS": f"{folder}/counters", "ROS_LOG_DIR": folder,
        }  # fmt: skip
        reference = Path(folder, "cost.yaml")
        reference.write_text(REFERENCE.format(low=options.hz / 2, high=options.hz * 2))
        started = [
            subprocess.Popen(
                [
                    ROSLENS, "run", "--", python, "-c", NODES, str(options.nodes * place // PROCESSES),
                    str(options.nodes * (place + 1) // PROCESSES), str(options.nodes),
                    str(options.topics // options.nodes), str(options.hz),
                ],
                env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            )
            for place in range(PROCESSES)
        ]  # fmt: skip
        output = Path(folder, "lines.json")
        words = ["watch", "--ros2", "--reference", str(reference), "--format", "json", "-o", str(output)]
        watch = subprocess.Popen([ROSLENS, *words], env=environment)
        try:
            end = time.monotonic() + LONGEST_S
            while len(judged(output)) < options.topics and time.monotonic() < end:
                time.sleep(1)
            time.sleep(WARM_S)
            measure(watch.pid, options.seconds)
        finally:
            for one in (watch, *started):
                one.send_signal(signal.SIGINT)
            for one in (watch, *started):
                one.wait(30)
        print(f"{len(judged(output))} topics were judged")
    return 0


def measure(pid: int, seconds: float) -> None:
    """Print what a process and those below it use in so many seconds."""
    processes = children(pid)
    before, began = {one: used(one) for one in processes}, time.monotonic()
    time.sleep(seconds)
    passed, total = time.monotonic() - began, 0.0
    print("| process | share of a core | MB at first | MB at last |\n| --- | --- | --- | --- |")
    for one in processes:
        (cpu, memory), (then, first) = used(one), before[one]
        total += cpu - then
        words = Path(f"/proc/{one}/cmdline").read_bytes().split(b"\0")
        name = "observer" if any(b"adapters.ros2" in word for word in words) else "monitor" if one == pid else "other"
        print(f"| {name} | {100 * (cpu - then) / passed:.1f} % | {first:.1f} | {memory:.1f} |")
    print(f"| all | {100 * total / passed:.1f} % | | |")


if __name__ == "__main__":
    sys.exit(main())
