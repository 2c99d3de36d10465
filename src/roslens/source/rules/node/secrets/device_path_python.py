"""Rule ``node.device_path_python``: a device that is another one tomorrow, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.secrets.device_path import of_string
from roslens.source.rules.rule import ROS_PYTHON, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the path of a numbered device that is no default of a parameter."""
    return of_string(node, view, "node.device_path_python", "call")


RULE = FileRule(
    id="node.device_path_python",
    title="Numbered device in the source (Python)",
    finds="`/dev/ttyUSB0`, `/dev/video1` and the like, in code of nodes, where it is no default of a parameter. Make "
    "it a "
    "parameter.",
    why="Numbers are given in the order of plugging: after the next start the motor controller is where the laser was.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("portability",),
    bad="import rospy\nport = serial.Serial('/dev/ttyUSB0', 115200)\n",
    good="import rospy\nport = serial.Serial(rospy.get_param('~port', '/dev/ttyUSB0'), 115200)\n",
    syntax="python",
    quoted=("/dev/tty", "/dev/video", "/dev/input/js", "/dev/i2c-"),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
