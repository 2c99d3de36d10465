"""Rule ``node.parameter_undeclared``: a parameter that is read and that nothing declares, in rclcpp."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import arguments, call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.parameters.undeclared import declares_nothing, is_always_there
from roslens.source.rules.rule import RCLCPP, FileRule

_MAKES_NODE = re.compile(
    rb"\bpublic\s+rclcpp::Node\b|\bmake_shared<\s*rclcpp::Node\s*>\s*\(|\brclcpp::Node::make_shared\s*\("
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a read of a parameter in a file that makes a node and declares nothing."""
    call, name = call_at(node), view.text(node)
    given = arguments(call) if call is not None else ()
    if call is None or not given or given[0].type != "string_literal" or is_always_there(view.text(given[0])):
        return
    if not declares_nothing(view) or _MAKES_NODE.search(view.code) is None or not _is_early(call, view):
        return
    text = view.text(given[0])
    follows = "the alternative stands" if name == "get_parameter_or" else "the variable stays as it was"
    problem = "throws ParameterNotDeclaredException" if len(given) == 1 else f"finds nothing, so that {follows}"
    yield view.hit(
        "node.parameter_undeclared",
        call,
        f"parameter {text} is declared nowhere in this file: `{name}` {problem}, also where a launch file gives a "
        f"value; expected `declare_parameter({text}, …)` before it",
    )


def _is_early(call: Node, view: FileView) -> bool:
    """Return whether a call stands in a constructor or in `main`: later on, others may have declared parameters."""
    function = function_around(call)
    if function is None or function.type != "function_definition":
        return False
    scope, _, name = function_name(function, view).rpartition("::")
    return name == "main" or (name != "" and scope.rpartition("::")[2] == name)


RULE = FileRule(
    id="node.parameter_undeclared",
    title="Parameter read and not declared",
    finds="`get_parameter` or `get_parameter_or` with a name, in a constructor or in `main`, in a file that defines or "
    "makes a node, declares no parameter at all and sets neither `allow_undeclared_parameters` nor "
    "`automatically_declare_parameters_from_overrides`.",
    why="Since ROS 2 Dashing only declared parameters exist. `get_parameter(name)` throws; `get_parameter(name, "
    "value)` and `get_parameter_or` ignore what parameter files and launch files give, and nothing says so.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters",),
    bad="""#include <rclcpp/rclcpp.hpp>
class Arm : public rclcpp::Node {
  Arm() : Node("arm") { get_parameter_or("limit", limit_, 0.5); }
};
""",
    good="""#include <rclcpp/rclcpp.hpp>
class Arm : public rclcpp::Node {
  Arm() : Node("arm") { limit_ = declare_parameter("limit", 0.5); }
};
""",
    syntax="cpp",
    anchors=("get_parameter", "get_parameter_or"),
    mentions=RCLCPP,
    spares_tests=True,
    found=found,
)
