"""Rule ``node.frame_slash``: a frame that begins with a slash, which tf2 refuses to look up."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_SLASHED = re.compile(r"(?:std::string\(\s*)?[fru]?(['\"])/[A-Za-z][\w/]*\1(?:\s*\)|s)?")
_FRAME = re.compile(r"(['\"])(?:[\w.]*[_.])?frame(?:_id|_name)?\1")
_BROADCAST = "Transform"
"""In the name of a type whose frames are sent to tf2, which takes the slash away there."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a text that begins with a slash and is given to ``frame_id``, or is the default of such a parameter."""
    text = _assigned(node, view) if view.text(node) == "frame_id" else _declared(node, view)
    if text is not None:
        name = view.text(text)
        message = f"frame {name} begins with a slash, and tf2 refuses to look up such a frame; expected it without"
        yield view.hit("node.frame_slash", text, message)


def _assigned(node: Node, view: FileView) -> Node | None:
    """Return the text that is given to ``….frame_id``; None where it is none, or of a transform that is sent."""
    target = node.parent
    if target is None or target.type not in ("field_expression", "attribute"):
        return None
    assignment = target.parent
    if assignment is None or assignment.type not in ("assignment_expression", "assignment"):
        return None
    value = assignment.child_by_field_name("right")
    if value is None or assignment.child_by_field_name("left") != target or not _SLASHED.fullmatch(view.text(value)):
        return None
    written = re.sub(r"^(?:self\.|this->)", "", view.text(target))
    owner = re.fullmatch(r"(\w+).*\bheader\s*\.\s*frame_id", written, re.DOTALL)
    return None if owner is None or _is_transform(owner[1], view) else value


def _is_transform(name: str, view: FileView) -> bool:
    """Return whether a variable is a transform, by its name or by what it is declared as."""
    if re.search(r"tf|trans", name, re.IGNORECASE):
        return True
    declared = rb"\w*" + _BROADCAST.encode() + rb"\w*[\s&*>]+" + re.escape(name.encode()) + rb"\b"
    made = rb"\b" + re.escape(name.encode()) + rb"\s*=\s*[\w.:]*" + _BROADCAST.encode()
    return re.search(declared + rb"|" + made, view.code) is not None


def _declared(node: Node, view: FileView) -> Node | None:
    """Return the default of a parameter that is named as a frame."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if len(given) < 2 or not _FRAME.fullmatch(view.text(given[0])):
        return None
    return given[1] if _SLASHED.fullmatch(view.text(given[1])) else None


RULE = FileRule(
    id="node.frame_slash",
    title="Frame that begins with a slash",
    finds='`header.frame_id = "/lidar"`, or a parameter for a frame with such a default. Leave the slash out. '
    "Transforms that are sent are let be: tf2 takes the slash away there.",
    why="tf2 ends each look-up of such a frame with an exception («tf2 frame_ids cannot start with a '/'»): nothing "
    "that is stamped with it can be transformed or shown.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("transforms", "messages"),
    bad='#include <rclcpp/rclcpp.hpp>\nvoid f() { cloud.header.frame_id = "/lidar"; }\n',
    good='#include <rclcpp/rclcpp.hpp>\nvoid f() { cloud.header.frame_id = "lidar"; }\n',
    syntax="cpp",
    anchors=("frame_id", "declare_parameter"),
    mentions=RCLCPP,
    spares_tests=True,
    found=found,
)
