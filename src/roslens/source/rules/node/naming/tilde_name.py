"""Rule ``node.tilde_name``: a private name where a node handle takes none."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FIRMWARE, ROSCPP, FileRule

_NEAR = 1000
"""So many bytes behind the name of a method its first argument begins, template arguments included."""

_NAMED_SO = re.compile(r"(?i)^n_?$|(?:^|_|ros|p|l|g)nh?_*\d*$|node|handle|nh_?$")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a method of a node handle with a literal that begins with ``~``."""
    # Nearly no call has one, and it is quicker to ask the text than the tree.
    if view.source.find(b'"~', node.end_byte, node.end_byte + _NEAR) < 0:
        return
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    of = view.text(receiver(call)) if call is not None else ""
    if not of or not given or view.mentions(FIRMWARE) or not _is_node_handle(of, view):
        return
    if given[0].type == "string_literal" and view.text(given[0]).startswith('"~'):
        yield view.hit(
            "node.tilde_name",
            given[0],
            f"`{view.text(given[0])}` in `{view.text(node)}` of a node handle, which throws for names with ~; "
            "expected a "
            '`ros::NodeHandle("~")`',
        )


def _is_node_handle(of: str, view: FileView) -> bool:
    """Return whether an object is one by its name, or a declaration in this file; others may read ~ by themselves."""
    name = re.split(r"\.|->|::", of.removesuffix("()"))[-1]
    if _NAMED_SO.search(name):
        return True
    declared = rb"NodeHandle(?:Ptr)?[\s&*>]+(?:\w+\s*,\s*)*" + re.escape(name.encode()) + rb"\b"
    return bool(name) and re.search(declared, view.code) is not None


RULE = FileRule(
    id="node.tilde_name",
    title="Private name in a method of a node handle",
    finds='`nh.getParam("~name", ...)` and the like. Use a `ros::NodeHandle("~")` and the name without ~, or '
    '`ros::param::get("~name", ...)`.',
    why="Methods of `ros::NodeHandle` throw InvalidNameException for names with ~: the node ends where it reads the "
    "parameter.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros1",),
    tags=("names", "parameters"),
    bad='#include <ros/ros.h>\nvoid f() { nh.getParam("~limit", limit); }\n',
    good='#include <ros/ros.h>\nvoid f() { private_nh.getParam("limit", limit); }\n',
    syntax="cpp",
    anchors=(
        *("getParam", "param", "hasParam", "setParam", "deleteParam", "getParamCached", "advertise", "subscribe"),
        *("advertiseService", "serviceClient"),
    ),
    mentions=ROSCPP,
    spares_tests=True,
    found=found,
)
