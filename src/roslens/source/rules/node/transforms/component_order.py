"""Rule ``node.component_order``: angles or parts of a quaternion in the order of another function."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, whole_name
from roslens.source.rules.cpp_flow.declared_with import made_with
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.transforms.named_components import angles_of, order_of
from roslens.source.rules.rule import ROS_CPP, FileRule

_ANGLES: Mapping[str, str] = {
    "setRPY": "rpy",
    "getRPY": "rpy",
    "createQuaternionFromRPY": "rpy",
    "createQuaternionMsgFromRollPitchYaw": "rpy",
    "setEulerYPR": "ypr",
    "getEulerYPR": "ypr",
    "setEulerZYX": "ypr",
    "getEulerZYX": "ypr",
}
"""The order of the three angles that a function takes or gives."""
_PARTS: Mapping[str, str] = {
    "tf2::Quaternion": "xyzw",
    "tf::Quaternion": "xyzw",
    "Eigen::Quaterniond": "wxyz",
    "Eigen::Quaternionf": "wxyz",
}
"""The order of the parts with which a quaternion is made."""
_SPOKEN = {"r": "roll", "p": "pitch", "y": "yaw"}
_OWN = re.compile(rb"\b(?:void|Quaternion|auto)\s+(?:\w+::)*(\w+)\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call whose arguments are in reverse by their names, or begin with the wrong end of a quaternion."""
    name = view.text(node)
    if name in _ANGLES:
        call = call_at(node)
        given = arguments(call)[:3] if call is not None else ()
        if len(given) == 3 and name.encode() not in view.names(_OWN):
            order = angles_of([view.text(one) for one in given])
            if order == _ANGLES[name][::-1]:
                taken, said = (", ".join(_SPOKEN[one] for one in text) for text in (_ANGLES[name], order))
                yield _hit(given[0], f"`{name}` has {taken}", said, view)
        return
    whole = view.text(whole_name(node))
    made = made_with(node) if whole in _PARTS else None
    if made is None or len(made) != 4:
        return
    order = order_of([view.text(one) for one in made])
    if order != _PARTS[whole] and order in _PARTS.values():
        yield _hit(made[0], f"`{whole}` is made of {', '.join(_PARTS[whole])}", ", ".join(order), view)


def _hit(node: Node, takes: str, given: str, view: FileView) -> Hit:
    return view.hit(
        "node.component_order",
        node,
        f"{takes}, and the arguments are {given} by their names; expected that order",
    )


RULE = FileRule(
    id="node.component_order",
    title="Angles or parts of a quaternion in another order",
    finds="Arguments whose names are those of a function's parameters in another order: yaw, pitch, roll (or z, y, x) "
    "in `setRPY`, roll, pitch, yaw in `setEulerYPR`; `w` first in `tf2::Quaternion`, which begins with x, and last in "
    "`Eigen::Quaterniond`, which begins with w. Negated angles and other orders, which turn axes on purpose, are left.",
    why="Roll becomes yaw, or the rotation is another one altogether: the robot is turned over in the map, and nothing "
    "says so.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms",),
    bad="#include <ros/ros.h>\nvoid f() { q.setRPY(yaw, pitch, roll); }\n",
    good="#include <ros/ros.h>\nvoid f() { q.setRPY(roll, pitch, yaw); }\n",
    syntax="cpp",
    anchors=("Quaterniond", "Quaternionf", "Quaternion", *_ANGLES),
    mentions=ROS_CPP,
    found=found,
)
