"""Rule ``node.node_before_init``: a node handle that is made before ``ros::init``."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import function_around, statement_around, whole_name
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FIRMWARE, ROSCPP, FileRule

_PLUGIN = re.compile(rb"\b(?:PLUGINLIB_(?:EXPORT|DECLARE)_CLASS|GZ_REGISTER_\w+_PLUGIN)\b")
"""A library with a plug-in is loaded by a process that has called ``ros::init``."""
_OBJECTS = ("identifier", "init_declarator", "array_declarator")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an object that needs ROS and is a global, or stands before ``ros::init`` in its function."""
    name = whole_name(node)
    declaration = name.parent
    if declaration is None or declaration.type != "declaration" or declaration.child_by_field_name("type") != name:
        return
    declarator = declaration.child_by_field_name("declarator")
    if declarator is None or declarator.type not in _OBJECTS or "extern" in view.text(declaration).split():
        return
    inner = declarator.child_by_field_name("declarator")
    if inner is not None and inner.type in ("pointer_declarator", "reference_declarator"):
        return
    # To search the whole file is dear, and most handles were members.
    if _is_loaded_otherwise(view):
        return
    function = function_around(declaration)
    if function is None and above(declaration, "class_specifier", "struct_specifier", "function_definition") is None:
        yield view.hit(
            "node.node_before_init",
            declaration,
            f"`{view.text(declaration)}` is global, so it is made before `ros::init`, which ends the process; "
            "expected it "
            "in `main` or in a class",
        )
    elif function is not None:
        begin = view.code.find(b"ros::init(", statement_around(declaration).end_byte, function.end_byte)
        if begin > 0 and b"ros::init(" not in view.code[function.start_byte : declaration.start_byte]:
            yield view.hit(
                "node.node_before_init",
                declaration,
                f"`{view.text(declaration)}` before `ros::init` ends the process; expected it after",
            )


def _is_loaded_otherwise(view: FileView) -> bool:
    """Return whether a file is firmware, or a plug-in, whose process has called ``ros::init`` before."""
    if view.mentions(FIRMWARE):
        return True
    return b"PLUGIN" in view.code and _PLUGIN.search(view.code) is not None


RULE = FileRule(
    id="node.node_before_init",
    title="Node made before ros::init",
    finds="A `ros::NodeHandle`, transform listener or broadcaster that is a global object, or is declared before "
    "`ros::init`. Declare it after, in `main` or a class.",
    why="roscpp says «You must call ros::init() before creating the first NodeHandle» and aborts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros1",),
    tags=("lifetime",),
    bad="#include <ros/ros.h>\nros::NodeHandle nh;\n",
    good='#include <ros/ros.h>\nint main(int c, char** v) { ros::init(c, v, "n"); ros::NodeHandle nh; }\n',
    syntax="cpp",
    anchors=(
        *("ros::NodeHandle", "tf::TransformListener", "tf::TransformBroadcaster", "tf2_ros::TransformListener"),
        "tf2_ros::TransformBroadcaster",
    ),
    mentions=ROSCPP,
    found=found,
)
