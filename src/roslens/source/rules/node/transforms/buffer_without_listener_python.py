"""Rule ``node.buffer_without_listener_python``: a buffer of transforms that is asked, and that nothing fills."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_MADE = re.compile(rb"(?:\bself\.)?\b(\w+)\s*=\s*(?:tf2_ros\.)?(?:buffer\.)?Buffer\(")
_ASKED = re.compile(rb"\b(\w+)\.(?:lookup_transform|can_transform|transform|lookup_transform_async)\(")
_FILLED = re.compile(rb"[lL]istener|set_transform|BufferClient|BufferServer")
_IMPORTED = re.compile(rb"import tf2_ros\b|from tf2_ros(?:\.buffer)? import\b[^\n]*\bBuffer\b")


def found(root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each buffer that the file makes and asks, where it names no listener and gives the buffer to nobody."""
    if view.has(_FILLED) or not view.has(_IMPORTED):
        return
    asked = view.names(_ASKED)
    for match in _MADE.finditer(view.code):
        name = match[1]
        node = root.descendant_for_byte_range(match.start(), match.end() - 1)
        if name in asked and node is not None and not _is_given_away(name, view):
            yield view.hit(
                "node.buffer_without_listener_python",
                node,
                f"`{name.decode()}` is asked for transforms, and nothing fills it: there is no TransformListener, so "
                "that each look-up fails; expected `TransformListener(buffer, node)`, which is kept",
            )


def _is_given_away(name: bytes, view: FileView) -> bool:
    """Return whether a buffer is an argument of something, or returned, so that another may fill it."""
    return (
        re.search(rb"(?:[(,=]\s*|\breturn\s+)(?:self\.)?%s\s*(?:[,)]|$)" % re.escape(name), view.code, re.MULTILINE)
        is not None
    )


RULE = FileRule(
    id="node.buffer_without_listener_python",
    title="Buffer of transforms that nothing fills (Python)",
    finds="A `Buffer` of tf2_ros that a file makes and asks by `lookup_transform` or `can_transform`, where no "
    "listener is named and the buffer is given to nobody else. Keep a `TransformListener` of it.",
    why="A buffer does not subscribe to /tf: without a listener it stays empty, and each look-up ends with an "
    "exception or False.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms",),
    bad="""import rclpy
from tf2_ros import Buffer
class Arm(Node):
    def __init__(self):
        self.buffer = Buffer()
    def look(self):
        return self.buffer.lookup_transform('map', 'base_link', Time())
""",
    good="""import rclpy
from tf2_ros import Buffer, TransformListener
class Arm(Node):
    def __init__(self):
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
    def look(self):
        return self.buffer.lookup_transform('map', 'base_link', Time())
""",
    syntax="python",
    whole=True,
    words=("lookup_transform", "can_transform", "transform"),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
