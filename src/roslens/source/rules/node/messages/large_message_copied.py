"""Rule ``node.large_message_copied``: a callback that gets a copy of an image or a cloud."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import STREAM, function_name
from roslens.source.rules.calls import body_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.messages.stamped import LARGE, SELDOM
from roslens.source.rules.rule import ROS_CPP, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a parameter that takes a large message by value, of a function that may be a callback."""
    name = node
    while name.parent is not None and name.parent.type == "qualified_identifier":
        name = name.parent
    parameter = name.parent
    declarator = parameter.child_by_field_name("declarator") if parameter is not None else None
    if parameter is None or parameter.type != "parameter_declaration" or declarator is None:
        return
    package, _, kind = view.text(name).rpartition("::")
    if declarator.type != "identifier" or "_msgs" not in package or kind != view.text(node):
        return
    function = parameter.parent.parent if parameter.parent is not None else None
    while function is not None and function.type not in ("function_definition", "lambda_expression", "declaration"):
        function = function.parent
    if function is None or function.type != "function_definition" or _is_changed(declarator, function, view):
        return
    yield view.hit(
        "node.large_message_copied",
        parameter,
        f"`{view.text(parameter)}` copies each message; expected `const {view.text(name)} &`, or a shared pointer to "
        "const",
        callback=STREAM + function_name(function, view),
    )


def _is_changed(declarator: Node, function: Node, view: FileView) -> bool:
    """Return whether a function changes its parameter or moves it on, and so needs a copy of its own."""
    name = re.escape(view.text(declarator).encode())
    changed = (
        rb"\b"
        + name
        + rb"\b(?:\.[\w.\[\]()]+|\[[^\]]*\])?\s*(?:[-+*/|&]?=(?!=)|\+\+|--)|\bmove\s*\(\s*"
        + name
        + rb"\s*\)"
    )
    calls = rb"|\b" + name + rb"\.[\w.]+\.(?:resize|push_back|clear|assign|swap|erase|insert)\s*\("
    body = body_of(function)
    code = view.code[body.start_byte : body.end_byte] if body is not None else b""
    return re.search(changed + calls, code) is not None


RULE = FileRule(
    id="node.large_message_copied",
    title="Large message taken by value",
    finds="A callback of a subscription that takes an image, cloud or scan by value and does not change it. Take a "
    "reference or a shared pointer to const.",
    why="A camera gives 30 MB a second and more: each copy takes time from the same core that should look at it.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("messages", "performance"),
    bad="""#include <ros/ros.h>
void Eye::on_image(sensor_msgs::Image image) { look(image); }
void Eye::start() { sub_ = nh_.subscribe("image", 1, &Eye::on_image, this); }
""",
    good="""#include <ros/ros.h>
void Eye::on_image(const sensor_msgs::ImageConstPtr & image) { look(*image); }
void Eye::start() { sub_ = nh_.subscribe("image", 1, &Eye::on_image, this); }
""",
    syntax="cpp",
    anchors=tuple(sorted(LARGE - SELDOM)),
    mentions=ROS_CPP,
    found=found,
)
