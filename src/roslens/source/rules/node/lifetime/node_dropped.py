"""Rule ``node.node_dropped``: a node that only the call of ``add_node`` knows, and that is gone behind it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_MAKES = ("std::make_shared<", "make_shared<", "std::make_unique<", "rclcpp::Node::make_shared(")
_OF_NODE = ("->get_node_base_interface()", ".get_node_base_interface()")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a node that is made as an argument of ``add_node``, and kept by nobody."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or not given or not _is_executor(receiver(call), view):
        return
    made = given[0]
    text = view.text(made)
    for ending in _OF_NODE:
        text = text.removesuffix(ending)
    if made.type != "call_expression" or not text.startswith(_MAKES) or not text.endswith(")"):
        return
    yield view.hit(
        "node.node_dropped",
        made,
        f"the node `{view.text(made)}` is destroyed when `add_node` returns, as the executor holds it weakly; "
        "expected a variable that keeps it while the executor spins",
    )


def _is_executor(one: Node | None, view: FileView) -> bool:
    """Return whether this file declares an object as an executor of rclcpp; other graphs may keep their nodes."""
    name = view.text(one)
    if not name.isidentifier():
        return False
    executor = r"rclcpp::[\w:]*Executor\b"
    declared = rf"{executor}[\w:>&*\s]*\s{name}\b|\b{name}\s*=\s*(?:std::make_\w+<\s*)?{executor}"
    return re.search(declared.encode(), view.code) is not None


RULE = FileRule(
    id="node.node_dropped",
    title="Node not kept beside its executor",
    finds="A node that is made in the call of `add_node`: `executor.add_node(std::make_shared<Arm>())`. Keep it in a "
    "variable. `rclcpp::spin(std::make_shared<Arm>())` is right: its argument lives as long as it spins.",
    why="An executor holds its nodes weakly. The shared pointer is a temporary, so that the node is gone at the end of "
    "the statement: the executor spins without it, and nothing says so.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("executor",),
    bad="""#include <rclcpp/rclcpp.hpp>
int main() {
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(std::make_shared<Arm>());
  executor.spin();
}
""",
    good="""#include <rclcpp/rclcpp.hpp>
int main() {
  rclcpp::executors::SingleThreadedExecutor executor;
  auto arm = std::make_shared<Arm>();
  executor.add_node(arm);
  executor.spin();
}
""",
    syntax="cpp",
    anchors=("add_node",),
    mentions=RCLCPP,
    found=found,
)
