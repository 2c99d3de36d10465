"""Rule ``node.nodelet_handle``: a nodelet that makes node handles of its own."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import function_around, whole_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a handle that ``onInit`` makes of nothing, or of a text."""
    name, function = whole_name(node), function_around(node)
    declaration = name.parent
    if declaration is None or function is None or declaration.type != "declaration":
        return
    if function.type != "function_definition" or function_name(function, view).rpartition("::")[2] != "onInit":
        return
    declarator = declaration.child_by_field_name("declarator")
    if declarator is None or declarator.type in ("pointer_declarator", "reference_declarator"):
        return
    value = declarator.child_by_field_name("value")
    if "NodeHandle" in view.text(declarator):
        return  # a copy of one that the nodelet gives
    if value is None or view.text(value).startswith('("'):
        yield view.hit(
            "node.nodelet_handle",
            declaration,
            f"`{view.text(declaration)}` in `onInit` is of the manager's process, not of this nodelet: remappings and "
            "the "
            "private namespace are others; expected `getNodeHandle()` or `getPrivateNodeHandle()`",
        )


RULE = FileRule(
    id="node.nodelet_handle",
    title="Nodelet that makes its own node handle",
    finds="`ros::NodeHandle nh;` in `onInit`. Use `getNodeHandle()`, `getPrivateNodeHandle()` or their MT forms.",
    why="A handle made of nothing belongs to the manager: names of the launch file for this nodelet do not count, `~` "
    "is the "
    "manager's, and its callbacks run in the wrong queue.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros1",),
    tags=("lifetime",),
    bad="#include <nodelet/nodelet.h>\nvoid Arm::onInit() { ros::NodeHandle nh; pub_ = nh.advertise<State>(a, 1); }\n",
    good="#include <nodelet/nodelet.h>\nvoid Arm::onInit() { pub_ = getNodeHandle().advertise<State>(a, 1); }\n",
    syntax="cpp",
    anchors=("ros::NodeHandle",),
    mentions=("nodelet",),
    found=found,
)
