"""Rule ``node.spin_in_constructor_python``: an ``__init__`` that never returns."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that spins for ever in ``__init__``."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or function.type != "function_definition":
        return
    name = function_name(function, view)
    if name.endswith(".__init__"):
        yield view.hit(
            "node.spin_in_constructor_python",
            call,
            f"`{view.text(call)}` in `{name}`, which does not return before shutdown; expected it in `main`",
        )


RULE = FileRule(
    id="node.spin_in_constructor_python",
    title="Constructor that spins (Python)",
    finds="`rospy.spin()` or `rclpy.spin(...)` in `__init__`. Spin in `main`.",
    why="The object is not there until shutdown: nothing can be called on it, no test can make it, and what derives "
    "from "
    "it never ends its own `__init__`.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="import rospy\nclass Arm:\n    def __init__(self):\n        rospy.spin()\n",
    good="import rospy\nclass Arm:\n    def __init__(self):\n        self.n = 0\nArm()\nrospy.spin()\n",
    syntax="python",
    anchors=("rospy.spin", "rclpy.spin"),
    mentions=ROS_PYTHON,
    found=found,
)
