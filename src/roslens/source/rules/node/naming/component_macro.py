"""Rule ``node.component_macro``: a component that is registered by a macro for other plug-ins."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_REGISTERS = re.compile(
    rb"\b(CLASS_LOADER_REGISTER_CLASS|PLUGINLIB_EXPORT_CLASS)\s*\(\s*([\w:<>, ]+?)\s*,\s*((?:::)?"
    rb"rclcpp(?:_lifecycle)?::(?:Node|LifecycleNode))\s*\)"
)


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each registration of a class as a plug-in whose base is a node."""
    for match in _REGISTERS.finditer(view.code):
        macro, name, base = (one.decode("utf-8", "replace") for one in match.groups())
        line, column = view.place(match.start())
        message = (
            f"{macro} registers `{name}` as a plug-in with the base `{base}`, for which containers have no factory; "
            f"expected RCLCPP_COMPONENTS_REGISTER_NODE({name})"
        )
        yield view.hit_at("node.component_macro", line, message, column=column)


RULE = FileRule(
    id="node.component_macro",
    title="Component registered by a macro for other plug-ins",
    finds="`CLASS_LOADER_REGISTER_CLASS` or `PLUGINLIB_EXPORT_CLASS` with `rclcpp::Node` or a lifecycle node as "
    "the base.",
    why="A component container loads factories of nodes, which `RCLCPP_COMPONENTS_REGISTER_NODE` makes. It finds none "
    "in the library and reports that the component could not be loaded.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("component",),
    bad="#include <rclcpp/rclcpp.hpp>\nCLASS_LOADER_REGISTER_CLASS(arm::Driver, rclcpp::Node)\n",
    good="#include <rclcpp/rclcpp.hpp>\nRCLCPP_COMPONENTS_REGISTER_NODE(arm::Driver)\n",
    syntax="cpp",
    whole=True,
    words=("CLASS_LOADER_REGISTER_CLASS", "PLUGINLIB_EXPORT_CLASS"),
    mentions=RCLCPP,
    found=found,
)
