"""Rule ``node.component_order_python``: angles or parts of a quaternion in the order of another function, in Python."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.transforms.named_components import angles_of, order_of
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_ANGLES = frozenset({"quaternion_from_euler", "euler2quat"})
"""Take roll, pitch and yaw, if no axes are named."""
_PARTS: Mapping[str, str] = {"euler_from_quaternion": "xyzw", "from_quat": "xyzw", "quat2euler": "wxyz"}
"""The order of the parts of a quaternion in the list that a function takes: of tf, scipy and transforms3d."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call whose arguments are in reverse by their names, or begin with the wrong end of a quaternion."""
    name, call = view.text(node), call_at(node)
    if call is None or keywords(call, view) or b"def " + name.encode() in view.code:
        # Further arguments name axes or the order; a function of the file's own may take another one.
        return
    given = arguments(call)
    if name in _ANGLES and len(given) == 3:
        if angles_of(_texts(given, view)) == "ypr":
            yield _hit(given[0], f"`{name}` takes roll, pitch, yaw", "yaw, pitch, roll", view)
    elif name in _PARTS and len(given) == 1 and given[0].type in ("list", "tuple"):
        order = order_of(_texts(given[0].named_children, view))
        if order != _PARTS[name] and order in _PARTS.values():
            yield _hit(given[0], f"`{name}` takes {', '.join(_PARTS[name])}", ", ".join(order), view)


def _texts(nodes: Sequence[Node], view: FileView) -> list[str]:
    return [view.text(one) for one in nodes]


def _hit(node: Node, takes: str, given: str, view: FileView) -> Hit:
    return view.hit(
        "node.component_order_python",
        node,
        f"{takes}, and is given {given} by their names; expected that order",
    )


RULE = FileRule(
    id="node.component_order_python",
    title="Angles or parts of a quaternion in another order (Python)",
    finds="Arguments whose names are those of a function's parameters in another order: yaw, pitch, roll (or z, y, x) "
    "in `quaternion_from_euler` without axes, `w` first in `euler_from_quaternion` or `Rotation.from_quat`, which "
    "begin with x, and last in `quat2euler` of transforms3d, which begins with w.",
    why="Roll becomes yaw, or the rotation is another one altogether: the robot is turned over in the map, and nothing "
    "says so.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms",),
    bad="import rclpy\nq = quaternion_from_euler(yaw, pitch, roll)\n",
    good="import rclpy\nq = quaternion_from_euler(roll, pitch, yaw)\n",
    syntax="python",
    anchors=("quaternion_from_euler", "euler_from_quaternion", "euler2quat", "quat2euler", "from_quat"),
    mentions=ROS_PYTHON,
    found=found,
)
