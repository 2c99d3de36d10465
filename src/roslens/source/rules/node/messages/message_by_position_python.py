"""Rule ``node.message_by_position_python``: a message of ROS 2 that is made with arguments by position."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_MODULE = re.compile(r"^[a-z][a-z0-9_]*\.msg$")
_NAME_BYTES = frozenset(bytes((one,)) for one in b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.")
_TIMES = {"rclpy.duration": "Duration", "rclpy.time": "Time"}


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the calls, with arguments by position, of the classes that an import of messages names."""
    module = view.text(node.child_by_field_name("module_name"))
    if not (_MODULE.match(module) or module in _TIMES) or b"rclpy" not in view.words or b"rospy" in view.words:
        return
    for name in node.children_by_field_name("name"):
        is_renamed = name.type == "aliased_import"
        original = view.text(name.child_by_field_name("name") if is_renamed else name)
        known = view.text(name.child_by_field_name("alias") if is_renamed else name)
        if module not in _TIMES or original == _TIMES[module]:
            yield from _by_position(known, f"{module}.{original}", view)


def _by_position(name: str, of: str, view: FileView) -> Iterator[Hit]:
    module, _, original = of.rpartition(".")
    for call in _calls(name, view):
        given = [one for one in arguments(call) if not one.type.endswith("_splat")]
        if given:
            yield view.hit(
                "node.message_by_position_python",
                call,
                f"`{view.short(call)}` gives `{of}` an argument by position, and it takes none: a TypeError; expected "
                f"its name, `{name}({_field(module, original)}={view.short(given[0], 30)})`",
            )


def _field(module: str, name: str) -> str:
    if module in _TIMES:
        return "seconds"
    return "data" if module == "std_msgs.msg" else f"field of {name}"


def _calls(name: str, view: FileView) -> Iterator[Node]:
    """Yield the calls of a name with arguments, unless the file binds it to something else, too."""
    code, called = view.code, name.encode() + b"("
    at = code.find(called)
    places = []
    while at >= 0:
        end = at + len(called)
        if code[end : end + 1] != b")" and code[at - 1 : at] not in _NAME_BYTES:
            places.append(at)
        at = code.find(called, end)
    if not places or _is_bound_again(name.encode(), code):
        return
    for at in places:
        node = view.node_at(at, at + len(name))
        call = call_at(node) if node is not None else None
        if call is not None:
            yield call


def _is_bound_again(name: bytes, code: bytes) -> bool:
    word = re.escape(name)
    again = rb"\b(?:class|def)\s+" + word + rb"\b|(?<![\w.])" + word + rb"\s*=(?!=)"
    return re.search(again, code) is not None or len(re.findall(rb"\bimport\b[^\n#]*\b" + word + rb"\b", code)) > 1


RULE = FileRule(
    id="node.message_by_position_python",
    title="Message made with arguments by position (rclpy)",
    finds="`Float64(0.5)`, `Point(x, y, z)`: in ROS 2 the classes of messages, and `Duration` and `Time` of rclpy, "
    "take arguments by name only: `Float64(data=0.5)`, `Duration(seconds=0.5)`.",
    why="rospy takes fields by position; in ROS 2 that is a TypeError at that line, and the node ends.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("messages",),
    bad="import rclpy\nfrom std_msgs.msg import Float64\npublisher.publish(Float64(0.5))\n",
    good="import rclpy\nfrom std_msgs.msg import Float64\npublisher.publish(Float64(data=0.5))\n",
    syntax="python",
    kinds=("import_from_statement",),
    mentions=RCLPY,
    found=found,
)
