"""Rule ``node.sleep_in_callback_python``: a callback in Python that sleeps."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, number_of, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.meant_pause import is_meant
from roslens.source.rules.flow.python_waits import WhereItWaits, where_it_waits
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_SLEEPERS = re.compile(r"^(time|rospy|.*rate|.*Rate\(.*|.*clock.*)$", re.ASCII | re.IGNORECASE)
_SHORTEST_S = 0.02
"""Shorter than the period of a usual control loop."""

_LONG_S = 1.0
"""Nobody waits that long for a device between two messages."""
_SEVERAL_THREADS = (b"MultiThreadedExecutor", b"ReentrantCallbackGroup", b"AsyncIOExecutor")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that sleeps in a callback; in rospy services and actions have threads of their own."""
    call = call_at(node)
    if call is None or any(one in view.code for one in _SEVERAL_THREADS):
        return
    of = receiver(call)
    if (of is not None and not _SLEEPERS.match(view.text(of))) or (of is None and b"import sleep" not in view.code):
        return
    length = number_of(next(iter(arguments(call)), None), view) or 0.0
    if 0 < length < _SHORTEST_S:
        return
    where = where_it_waits(call, view)
    if where is not None:
        yield view.hit(
            "node.sleep_in_callback_python",
            call,
            f"`{view.text(call)}` in {where.spoken}: messages queue up meanwhile; expected a timer that goes on later",
            callback=where.callback,
            certainty=None if _is_surely_late(length, where, call, view) else Certainty.HEURISTIC,
        )


def _is_surely_late(length: float, where: WhereItWaits, call: Node, view: FileView) -> bool:
    return length >= _LONG_S and not where.takes_time and not is_meant(call, view)


RULE = FileRule(
    id="node.sleep_in_callback_python",
    title="Sleep in a callback (Python)",
    finds="A callback that sleeps, or a function that it calls: of a subscription or timer, in rclpy of a service or "
    "action too. Let a timer go on later instead. A sleep of less than a second, or of a length that is computed, is a "
    "note: a device may need it. So is one that a comment or a logged message explains, that is how long a published "
    "command holds, that is one of four or more in a function (a sequence of movements), or that an example has, and "
    "one where goals of an action are carried out, which may take their time: only other callbacks wait.",
    why="rclpy runs all callbacks in one thread by default, rospy all of a connection: messages queue up, and "
    "what is handled afterwards is old.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "real-time"),
    bad="""import time, rclpy
class Arm(Node):
    def __init__(self):
        self.sub = self.create_subscription(Goal, "goal", self.on_goal, 10)
    def on_goal(self, goal):
        time.sleep(2)
        self.open()
""",
    good="""import time, rclpy
class Arm(Node):
    def __init__(self):
        self.sub = self.create_subscription(Goal, "goal", self.on_goal, 10)
    def on_goal(self, goal):
        self.opening = self.create_timer(2, self.open)
""",
    syntax="python",
    anchors=("sleep", "sleep_for", "sleep_until"),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
