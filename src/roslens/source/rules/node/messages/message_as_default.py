"""Rule ``node.message_as_default``: a message that all calls share."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_IMPORT = re.compile(rb"^[ \t]*from[ \t]+[\w.]+\.(?:msg|srv|action)[ \t]+import[ \t]+([^\n#]+)", re.MULTILINE)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a default value of a parameter that makes a message."""
    value = node.child_by_field_name("value")
    called = view.text(value.child_by_field_name("function")) if value is not None and value.type == "call" else ""
    if value is None or not called or called.rpartition(".")[2].encode() not in _imported(view):
        return
    name = view.text(node.child_by_field_name("name"))
    yield view.hit(
        "node.message_as_default",
        value,
        f"default `{name}={view.text(value)}` is one message that all calls share; expected `{name}=None` and a new "
        "one "
        "inside",
    )


def _imported(view: FileView) -> set[bytes]:
    return {word for one in _IMPORT.finditer(view.content) for word in re.findall(rb"\w+", one[1])}


RULE = FileRule(
    id="node.message_as_default",
    title="Message as a default value",
    finds="A parameter whose default value makes a message: `def drive(self, twist=Twist())`. Use None and make it "
    "inside.",
    why="Python makes it once, when the function is defined: what one call writes into it, a velocity for example, "
    "the next "
    "call sends.",
    profiles=("ros2", "ros1"),
    tags=("messages",),
    bad="import rospy\nfrom geometry_msgs.msg import Twist\ndef drive(twist=Twist()):\n    pub.publish(twist)\n",
    good="import rospy\nfrom geometry_msgs.msg import Twist\ndef drive(twist=None):\n    pub.publish(twist or "
    "Twist())\n",
    syntax="python",
    kinds=("default_parameter", "typed_default_parameter"),
    mentions=ROS_PYTHON,
    found=found,
)
