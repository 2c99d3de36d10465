"""What counting inside a Python node costs a message.

    python benchmarks/inside_python.py [PYTHON WITH RCLPY]

First the hook alone: a taken and a published message through functions shaped like those of rclpy, with
and without the hook, the least of many short rounds: what another process takes of the machine is in the longer ones.
A turn of an empty loop tells how fast the machine is. Then, where a Python with rclpy is given or found in
build/ros2, the CPU time a message of a 500 Hz relay node, with and without, in turn in one process.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import timeit
from pathlib import Path
from types import ModuleType
from typing import Any

from roslens.live.inside import rclpy_hook, slots
from roslens.live.inside.environment import environment

ROUNDS = 400
CALLS = 1_000
GID = bytes(range(16))

RELAY = """
import rclpy, statistics, time
from std_msgs.msg import Header
from roslens_inside.rclpy_hook import HOOK
rclpy.init()
node = rclpy.create_node('relay')
out = node.create_publisher(Header, 'out', 100)
first = node.create_publisher(Header, 'in', 100)
taken = 0
def relay(message):
    global taken
    taken += 1
    out.publish(message)
node.create_subscription(Header, 'in', relay, 100)
message = Header()
node.create_timer(0.002, lambda: first.publish(message))
hooked = [(owner, name, getattr(owner, name)) for owner, name, _ in HOOK.undo]
def stretch(functions):
    global taken
    for owner, name, function in functions:
        setattr(owner, name, function)
    taken, begun, end = 0, time.process_time(), time.monotonic() + 0.5
    while time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=1)
    return (time.process_time() - begun) / taken * 1e6
stretch(hooked)
pairs = [(stretch(HOOK.undo), stretch(hooked)) for _ in range(20)]
without, counting = zip(*pairs)
added = sorted(b - a for a, b in pairs)
print(statistics.median(without), statistics.median(counting), statistics.median(added), added[5], added[14])
"""


class Stamped:
    """A message with a header."""

    class header:  # noqa: N801 - an attribute of the message
        class stamp:  # noqa: N801
            sec, nanosec = 1_699_999_999, 5


class Handle:
    """Gives one message after the other, as fast as it is asked."""

    number = 0

    def __enter__(self) -> None:
        return None

    def __exit__(self, *_: object) -> None:
        return None

    def get_topic_name(self) -> str:
        return "/topic"

    def get_logger_name(self) -> str:
        return "node"

    def publish(self, _: object) -> None:
        return None

    def take_message(self, _type: object, _raw: bool) -> tuple[Any, dict[str, Any]]:
        self.number += 1
        when = 1_700_000_000_000_000_000 + self.number * 1_000_000
        return Stamped, {
            "source_timestamp": when,
            "received_timestamp": when + 50_000,
            "publication_sequence_number": self.number,
            "publisher_gid": {"data": GID},
        }


class Type:
    @staticmethod
    def get_fields_and_field_types() -> dict[str, str]:
        return {"header": "std_msgs/Header"}


class Subscription:
    raw = False

    def __init__(self, kind: type) -> None:
        self.handle = Handle()
        self.msg_type = kind


class Executor:
    def _take_subscription(self, subscription: Any) -> Any:
        with subscription.handle:
            return subscription.handle.take_message(subscription.msg_type, subscription.raw)


class Publisher:
    def __init__(self) -> None:
        self.handle = Handle()

    def publish(self, msg: object) -> None:
        with self.handle:
            self.handle.publish(msg)


def least(function: Any) -> float:
    """Return the microseconds of one call."""
    return min(timeit.repeat(function, number=CALLS, repeat=ROUNDS)) / CALLS * 1e6


def alone() -> None:
    """Print what the hook adds to a message."""
    executor, publisher = Executor(), Publisher()
    subscription, of_stamped = Subscription(object), Subscription(Type)

    def take() -> None:
        executor._take_subscription(subscription)  # noqa: SLF001 - what is replaced is private

    def take_stamped() -> None:
        executor._take_subscription(of_stamped)  # noqa: SLF001

    def publish() -> None:
        publisher.publish(None)

    def turns() -> None:
        for _ in range(100):
            pass

    bare = least(take), least(publish)
    with tempfile.TemporaryDirectory() as folder:
        os.environ[slots.VARIABLE] = folder
        module = ModuleType("rclpy")
        module.__dict__.update(Executor=Executor, Publisher=Publisher)
        rclpy_hook.hook_executor(module)
        rclpy_hook.hook_publisher(module)
        taken, aged = least(take), least(take_stamped)
        answering = least(publish)
        rclpy_hook._CURRENT.given = None  # noqa: SLF001 - what a timer does
        publishing = least(publish)
        rclpy_hook.HOOK.close()
    print(f"turn of an empty loop {least(turns) * 10:.1f} ns")
    print(f"taken      +{taken - bare[0]:.2f} us a message")
    print(f"taken with a header +{aged - bare[0]:.2f} us a message")
    print(f"published  +{publishing - bare[1]:.2f} us a message")
    print(f"published in answer +{answering - bare[1]:.2f} us a message")


def relay(python: str) -> None:
    """Print the CPU time of a relay node with and without the hook, in turn in one process."""
    with tempfile.TemporaryDirectory() as folder:
        plain = {name: text for name, text in os.environ.items() if name not in (slots.VARIABLE, "PYTHONPATH")}
        plain.update(ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST", ROS_DOMAIN_ID="87")
        counting = plain | environment(plain | {slots.VARIABLE: folder})
        ended = subprocess.run([python, "-c", RELAY], env=counting, capture_output=True, text=True, check=True)
    off, on, added, low, high = (float(word) for word in ended.stdout.split())
    print(f"relay at 500 Hz: {off:.0f} us CPU a message without the hook, {on:.0f} with it")
    print(f"added to one taken and two published: {added:.0f} us (middle half of 20 pairs {low:.0f} to {high:.0f})")


if __name__ == "__main__":
    alone()
    given = sys.argv[1] if len(sys.argv) > 1 else "build/ros2/bin/python"
    if Path(given).exists():
        relay(given)
    else:
        print(f"no {given}: the relay was not run")
