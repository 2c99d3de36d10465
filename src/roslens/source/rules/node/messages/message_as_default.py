"""Rule ``node.message_as_default``: a message that all calls share."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_IMPORT = re.compile(rb"^[ \t]*from[ \t]+[\w.]+\.(?:msg|srv|action)[ \t]+import[ \t]+([^\n#]+)", re.MULTILINE)
_WRITTEN = r"(?<![\w.]){}(?:\.\w+|\[[^]]*\])+\s*(?:[-+*/|&]?=(?!=)|\.?(?:append|extend|insert)\()"


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a default value of a parameter that makes a message."""
    value = node.child_by_field_name("value")
    called = view.text(value.child_by_field_name("function")) if value is not None and value.type == "call" else ""
    if value is None or not called or called.rpartition(".")[2].encode() not in _imported(view):
        return
    name, function = view.text(node.child_by_field_name("name")), function_around(node)
    if function is None or not _is_written(name, view.text(function)) or _is_never_used(node, function, view):
        return
    yield view.hit(
        "node.message_as_default",
        value,
        f"default `{name}={view.text(value)}` is one message that all calls share; expected `{name}=None` and a new "
        "one "
        "inside",
    )


def _is_written(name: str, function: str) -> bool:
    """Tell whether a function writes into a parameter, or calls what may: what is only read may be shared."""
    return re.search(_WRITTEN.format(re.escape(name)), function) is not None


def _is_never_used(parameter: Node, function: Node, view: FileView) -> bool:
    """Return whether a first parameter is handed over by every call of its function in the file, and there is one."""
    before = parameter.prev_named_sibling
    if before is not None and view.text(before) not in ("self", "cls"):
        return False
    name = re.escape(view.text(function.child_by_field_name("name")).encode())
    calls = re.findall(rb"(?<!def )\b" + name + rb"\s*\(\s*(\)?)", view.code) if name else []
    return bool(calls) and not any(calls)


def _imported(view: FileView) -> set[bytes]:
    return {word for one in _IMPORT.finditer(view.content) for word in re.findall(rb"\w+", one[1])}


RULE = FileRule(
    id="node.message_as_default",
    title="Message as a default value",
    finds="A parameter whose default value makes a message: `def drive(self, twist=Twist())`, and is "
    "written into. Use None and make it inside.",
    why="Python makes it once, when the function is defined: what one call writes into it, a velocity for example, "
    "the next "
    "call sends.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("messages",),
    bad="import rospy\nfrom geometry_msgs.msg import Twist\ndef drive(twist=Twist()):\n    twist.linear.x += 0.1\n    "
    "pub.publish(twist)\n",
    good="import rospy\nfrom geometry_msgs.msg import Twist\ndef drive(twist=None):\n    pub.publish(twist or "
    "Twist())\n",
    syntax="python",
    kinds=("default_parameter", "typed_default_parameter"),
    mentions=ROS_PYTHON,
    found=found,
)
