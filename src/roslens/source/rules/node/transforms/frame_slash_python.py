"""Rule ``node.frame_slash_python``: a frame that begins with a slash, which tf2 refuses to look up, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace
from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.transforms import frame_slash
from roslens.source.rules.rule import RCLPY, FileRule

_ID = "node.frame_slash_python"


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield what :mod:`~roslens.source.rules.node.transforms.frame_slash` does."""
    for hit in frame_slash.found(node, view):
        yield replace(hit, rule=_ID)


RULE = FileRule(
    id=_ID,
    title="Frame that begins with a slash (Python)",
    finds='`header.frame_id = "/lidar"`, or a parameter for a frame with such a default. Leave the slash out. '
    "Transforms that are sent are let be: tf2 takes the slash away there.",
    why="tf2 ends each look-up of such a frame with an exception («tf2 frame_ids cannot start with a '/'»): nothing "
    "that is stamped with it can be transformed or shown.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("transforms", "messages"),
    bad='import rclpy\nscan.header.frame_id = "/lidar"\n',
    good='import rclpy\nscan.header.frame_id = "lidar"\n',
    syntax="python",
    anchors=("frame_id", "declare_parameter"),
    mentions=RCLPY,
    spares_tests=True,
    found=found,
)
