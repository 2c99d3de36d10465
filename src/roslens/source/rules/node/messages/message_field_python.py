"""Rule ``node.message_field_python``: a field that a message does not have."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import is_handled, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_messages import PythonMessages, python_messages
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule
from roslens.source.rules.signatures.read_messages import Fields, fields_of

_OF_EACH = frozenset({"get_fields_and_field_types", "SLOT_TYPES"})
_ROS1 = {
    ("std_msgs/Header", "seq"): "nothing: messages of ROS 2 are not counted",
    ("builtin_interfaces/Time", "secs"): "`sec`",
    ("builtin_interfaces/Time", "nsecs"): "`nanosec`",
    ("builtin_interfaces/Time", "to_sec"): "`Time.from_msg(…)` of rclpy.time",
    ("builtin_interfaces/Time", "nanoseconds"): "`Time.from_msg(…)` of rclpy.time",
    ("builtin_interfaces/Duration", "secs"): "`sec`",
    ("builtin_interfaces/Duration", "nsecs"): "`nanosec`",
}
"""What messages of ROS 1 have, and what takes its place."""
_ASKS = re.compile(rb"hasattr|getattr|__slots__")


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each use of a field of a message of a known type that has no such field."""
    messages = python_messages(view)
    if not messages.imported or b"rospy" in view.words or view.has(_ASKS):
        return
    for attribute in view.nodes("attribute"):
        kind = messages.type_of(attribute.child_by_field_name("object"))
        fields = fields_of(kind)
        name = view.text(attribute.child_by_field_name("attribute"))
        if fields is not None and not _has(fields, name) and not is_handled(attribute):
            yield _hit(attribute, name, kind, fields, view)
    yield from _by_keyword(messages, view)


def _by_keyword(messages: PythonMessages, view: FileView) -> Iterator[Hit]:
    """Yield each argument by name, of a message that is made, that is none of its fields."""
    for call in python_functions(view).calls:
        kind = messages.type_of(call)
        fields = fields_of(kind)
        for name, value in keywords(call, view).items() if fields is not None else ():
            if fields is not None and name not in fields.types and not name.startswith("*") and name != "check_fields":
                yield _hit(value, name, kind, fields, view)


def _has(fields: Fields, name: str) -> bool:
    return name in fields.types or name in _OF_EACH or name.startswith("_") or name.isupper()


def _hit(at: Node, name: str, kind: str, fields: Fields, view: FileView) -> Hit:
    shown = kind.replace("/", ".msg.") if not kind.endswith(("_Request", "_Response")) else kind.replace("/", ".srv.")
    near = get_close_matches(name, fields.types, 1)
    expected = _ROS1.get((kind, name)) or (f"`{near[0]}`" if near else "one of " + _listed(fields))
    return view.hit("node.message_field_python", at, f"`{shown}` has no field `{name}`; expected {expected}")


def _listed(fields: Fields) -> str:
    return ", ".join(f"`{one}`" for one in [*fields.types][:6]) or "none, as it is empty"


RULE = FileRule(
    id="node.message_field_python",
    title="Field that the message does not have (rclpy)",
    finds="A field of a message of builtin_interfaces, std_msgs, geometry_msgs, sensor_msgs, nav_msgs, diagnostic_msgs "
    "or tf2_msgs, or of a request or response of std_srvs, that it does not have: misspelt, of another message, or of "
    "ROS 1 (`stamp.secs`, `header.seq`). The type has to be certain: of what a variable is made, or of the "
    "subscription or service whose callback gets it.",
    why="Messages take no other attributes: AttributeError with the first message, which ends the node.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("messages",),
    bad="""import rclpy
from geometry_msgs.msg import Twist
def drive(publisher):
    command = Twist()
    command.linear_x = 0.2
    publisher.publish(command)
""",
    good="""import rclpy
from geometry_msgs.msg import Twist
def drive(publisher):
    command = Twist()
    command.linear.x = 0.2
    publisher.publish(command)
""",
    syntax="python",
    whole=True,
    gathers=("attribute",),
    words=("msg", "srv"),
    mentions=RCLPY,
    found=found,
)
