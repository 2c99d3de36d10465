"""Rule ``node.spin_sometimes``: a loop that looks for messages only under a condition."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at, loop_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_SPINS = re.compile(rb"(?i)spin|executor")
"""Whatever else may serve callbacks; a file that has it once has it in the loop only."""
_WHILE_OK = re.compile(r"\bok\(\)")
_MEANT = re.compile(r"\bok\(\)|%|(?i:time|now|spin|rate|sleep|count)")
"""In conditions that hold each time, or from time to time."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the only call that serves callbacks where a branch of the loop that lasts as long as the node has it."""
    call = call_at(node)
    loop = loop_around(call) if call is not None else None
    if call is None or loop is None or loop.type != "while_statement":
        return
    if not _WHILE_OK.search(view.text(loop.child_by_field_name("condition"))) or not _is_alone(call, view):
        return
    branch = _branch(call, loop)
    if branch is None or branch.child_by_field_name("alternative") is not None:
        return
    condition = view.text(branch.child_by_field_name("condition")).strip()
    if not _MEANT.search(condition):
        line = branch.start_point[0] + 1
        yield view.hit(
            "node.spin_sometimes",
            call,
            f"`{view.text(call)}` stands in the `if` of line {line}: callbacks run only while "
            f"`{condition.strip('()')}` holds; expected it in the loop itself",
        )


def _is_alone(call: Node, view: FileView) -> bool:
    outside = view.code[: call.start_byte] + view.code[call.end_byte :]
    includes = re.sub(rb"(?m)^\s*#.*$", b"", outside)
    return _SPINS.search(includes) is None


def _branch(call: Node, loop: Node) -> Node | None:
    """Return the only `if` between a call and its loop, where it stands in the first arm of it."""
    found, inner, node = None, call, call.parent
    while node is not None and node != loop:
        if node.type in ("if_statement", "switch_statement", "try_statement", "case_statement"):
            if found is not None or node.type != "if_statement" or node.child_by_field_name("consequence") != inner:
                return None
            found = node
        inner, node = node, node.parent
    return found


RULE = FileRule(
    id="node.spin_sometimes",
    title="Callbacks that run under a condition only",
    finds="A loop `while (ros::ok())` whose only `spinOnce` or `spin_some` stands in an `if` without `else`, in a file "
    "that spins nowhere else. Call it each time round. Conditions on time, counters and `ok()` are left.",
    why="As long as the condition does not hold, no subscription, service or timer is served, and queues fill up: the "
    "node seems dead, and cannot be told what would make the condition true.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="#include <ros/ros.h>\nint main() {\n  while (ros::ok()) {\n    if (camera.grab()) {\n      publish();\n"
    "      ros::spinOnce();\n    }\n    rate.sleep();\n  }\n}\n",
    good="#include <ros/ros.h>\nint main() {\n  while (ros::ok()) {\n    if (camera.grab()) {\n      publish();\n    "
    "}\n    ros::spinOnce();\n    rate.sleep();\n  }\n}\n",
    syntax="cpp",
    anchors=("spinOnce", "spin_some"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
