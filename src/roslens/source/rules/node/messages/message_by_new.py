"""Rule ``node.message_by_new``: a message that nobody owns."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import function_around
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_MESSAGE = re.compile(r"^\w+_(msgs|interfaces)::")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``new`` of a message that a plain pointer takes."""
    made = node if node.type == "new_expression" else node.parent
    if made is None or made.type != "new_expression" or not _MESSAGE.match(view.text(made.child_by_field_name("type"))):
        return
    around = made.parent
    declarator = around.child_by_field_name("declarator") if around is not None else None
    if declarator is None or declarator.type != "pointer_declarator":
        return
    name, function = view.text(name_node(declarator)), function_around(made)
    after = view.code[made.end_byte : function.end_byte].decode("utf-8", "replace") if function is not None else ""
    if name and re.search(rf"\.reset\(\s*{name}\b|[pP]tr\w*(?:<[^;()]*>)?[({{]\s*{name}\b|publish\(\s*{name}\b", after):
        return  # an owner takes it
    kind = view.text(made.child_by_field_name("type"))
    yield view.hit(
        "node.message_by_new",
        made,
        f"`{view.text(made)}` in a plain pointer, which nothing deletes when a callback throws or returns; expected "
        f"`std::make_unique<{kind}>()`",
    )


RULE = FileRule(
    id="node.message_by_new",
    title="Message made with new and kept in a plain pointer",
    finds="`T * message = new T` of a message. Use `std::make_unique` or `std::make_shared`, or a variable.",
    why="A node publishes for months: a message that is not deleted on one path out of a callback takes the memory of "
    "the "
    "robot's computer. A unique pointer can also be published without a copy.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("messages", "memory"),
    bad="#include <ros/ros.h>\nvoid f() { sensor_msgs::Image * image = new sensor_msgs::Image(); fill(image); }\n",
    good="#include <ros/ros.h>\nvoid f() { auto image = boost::make_shared<sensor_msgs::Image>(); fill(image); }\n",
    syntax="cpp",
    anchors=("new",),
    mentions=ROS_CPP,
    found=found,
)
