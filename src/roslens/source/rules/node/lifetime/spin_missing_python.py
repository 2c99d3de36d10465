"""Rule ``node.spin_missing_python``: a program in Python that subscribes and ends at once."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.calls import call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_NEEDS_SPIN = re.compile(rb"\b(Subscriber|create_subscription|create_service|create_timer|Service)\b\s*\(")
_STAYS = re.compile(
    rb"[sS]pin|\bwhile\b|[sS]leep|[wW]ait|mainloop|exec_?\b|\binput\b|raw_input|[rR]un|join\s*\(|[lL]oop|Executor|execute|"
    rb"unittest|rostest|\.main\s*\(|\.start\s*\("
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the beginning of a program that subscribes, in a file in which nothing waits."""
    call = call_at(node)
    if call is None or (b"__main__" not in view.content and b"def main" not in view.content):
        return
    registers = _NEEDS_SPIN.search(view.code)
    if registers is None or _STAYS.search(view.code):
        return
    is_rospy = view.text(node) == "init_node"
    yield view.hit(
        "node.spin_missing_python",
        call,
        f"the program makes `{registers[1].decode()}` and nothing in this file spins or waits: it ends at once; "
        "expected " + ("`rospy.spin()`" if is_rospy else "`rclpy.spin(node)`"),
    )


RULE = FileRule(
    id="node.spin_missing_python",
    title="Program that never spins (Python)",
    finds="A program that makes a subscription, service or timer, in a file in which nothing spins or waits. Spin.",
    why="The program ends at once, and with it the node; under a launch that respawns it, it comes and goes.",
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="import rospy\ndef main():\n    rospy.init_node('n')\n    rospy.Subscriber('x', String, f)\n",
    good="import rospy\ndef main():\n    rospy.init_node('n')\n    rospy.Subscriber('x', String, f)\n    "
    "rospy.spin()\n",
    syntax="python",
    anchors=("init_node", "rclpy.init"),
    mentions=ROS_PYTHON,
    found=found,
)
