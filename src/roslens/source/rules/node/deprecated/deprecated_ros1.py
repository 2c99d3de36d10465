"""Rule ``node.deprecated_ros1``: names of ROS 1 that are deprecated or gone."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.deprecated.table import CPP_ROS1, find
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a name of the table."""
    return find(node, view, "node.deprecated_ros1", _ROWS)


_ROWS = CPP_ROS1

RULE = FileRule(
    id="node.deprecated_ros1",
    title="Deprecated name of ROS 1",
    finds="A name that a distribution deprecated or removed. The finding says since when, and what to write.",
    why="What is deprecated warns in every build of everybody who uses it, and with the next distribution it does not "
    "build.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("deprecated",),
    bad="#include <pluginlib/class_list_macros.hpp>\nPLUGINLIB_DECLARE_CLASS(arm, Driver, arm::Driver, arm::Base);\n",
    good="#include <pluginlib/class_list_macros.hpp>\nPLUGINLIB_EXPORT_CLASS(arm::Driver, arm::Base);\n",
    syntax="cpp",
    anchors=tuple(row.name for row in CPP_ROS1),
    mentions=("pluginlib",),
    found=found,
)
