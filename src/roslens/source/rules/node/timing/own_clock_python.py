"""Rule ``node.own_clock_python``: a clock that no node drives, in rclpy."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.timing.stamp_flow import reached
from roslens.source.rules.rule import RCLPY, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the present time of a clock that was made just for it."""
    call = call_at(node)
    around = call.parent if call is not None else None
    if call is None or around is None or around.type != "attribute" or "STEADY" in view.text(call):
        return
    read = around.parent
    if view.text(around.child_by_field_name("attribute")) != "now" or read is None:
        return
    end = reached(read, view)
    carried = end.carried if end is not None else ""
    if end is not None and not end.is_stamp and "ROS_TIME" not in view.text(call):
        carried += (
            ", which raises TypeError, for the clocks differ" if carried else "; times of two clocks raise TypeError"
        )
    yield view.hit(
        "node.own_clock_python",
        around,
        f"`{view.text(around)}()` reads the computer's clock, whatever `use_sim_time` says{carried}; expected "
        "`self.get_clock().now()`",
        certainty=None if end is not None else Certainty.HEURISTIC,
    )


RULE = FileRule(
    id="node.own_clock_python",
    title="Clock that belongs to no node (Python)",
    finds="`Clock().now()`: the time of a clock that was made on the spot. Use `get_clock()` of the node. The time is "
    "followed through variables, attributes and functions of the file; what goes into no stamp and meets no time of "
    "ROS is a note.",
    why="Only a node's clock follows /clock: in simulation and in a played bag the stamps are years off, and "
    "transforms of "
    "them do not exist.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("time", "simulation"),
    bad="import rclpy\nfrom rclpy.clock import Clock\nmsg.header.stamp = Clock().now().to_msg()\n",
    good="import rclpy\nmsg.header.stamp = node.get_clock().now().to_msg()\n",
    syntax="python",
    anchors=("Clock",),
    mentions=RCLPY,
    spares_tests=True,
    found=found,
)
