"""Rule ``node.parameter_redeclared``: a parameter is declared that the node declares of itself where it is given."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, is_handled, receiver
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_DECLARING = b"declare_parameter"
_THIS = frozenset(("", "this"))


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each declaration of a parameter by a node that was made with options which declare what is given."""
    call = call_at(node)
    given = [view.text(one) for one in arguments(call)] if call is not None else []
    if call is None or given != ["true"]:
        return
    names, scope = _nodes_made_with(call, view)
    for at in word_places(_DECLARING, view, scope.start_byte, scope.end_byte) if scope is not None else ():
        word = view.node_at(at, at + len(_DECLARING))
        declaring = call_at(word) if word is not None else None
        of = view.text(receiver(declaring)) if declaring is not None else None
        if declaring is None or of not in names or not arguments(declaring) or _is_guarded(declaring, view):
            continue
        named = view.short(arguments(declaring)[0])
        line = call.start_point[0] + 1
        yield view.hit(
            "node.parameter_redeclared",
            declaring,
            f"parameter {named} is declared, and the options of the node (line {line}) declare whatever it is given: "
            "ParameterAlreadyDeclaredException as soon as a launch file sets it; expected `has_parameter` to be asked "
            "before, or the option to be left out",
        )


def _nodes_made_with(call: Node, view: FileView) -> tuple[frozenset[str], Node | None]:
    """Return how a node is called that is made with the options of a call, and where it is called so."""
    function = function_around(call)
    if above(call, "field_initializer") is not None:
        body = body_of(function) if function is not None else None
        return _THIS, body
    if function is None or function.type != "function_definition":
        return frozenset(), None
    options = receiver(call)
    while options is not None and options.type == "call_expression" and receiver(options) is not None:
        options = receiver(options)
    declared = above(call, "init_declarator")
    name = view.text(declared.child_by_field_name("declarator")) if declared is not None else view.text(options)
    if declared is not None and "make_shared" in view.text(declared):
        return frozenset((name,)), function
    if not name.isidentifier():
        return frozenset(), None
    code = view.code[function.start_byte : function.end_byte]
    made = rf"\b(\w+)\s*=\s*(?:std::)?make_shared<[\w:]*Node>\s*\([^;]*\b{name}\b".encode()
    return frozenset(one.decode() for one in re.findall(made, code)), function


def _is_guarded(declaring: Node, view: FileView) -> bool:
    """Return whether somebody asks before, or catches what is thrown."""
    function = function_around(declaring)
    if is_handled(declaring) or function is None:
        return True
    return b"has_parameter" in view.code[function.start_byte : declaring.start_byte]


RULE = FileRule(
    id="node.parameter_redeclared",
    title="Parameter declared a second time",
    finds="`declare_parameter` of a node that is made with `automatically_declare_parameters_from_overrides(true)`, "
    "without `has_parameter` before it and outside of `try`.",
    why="The option declares every parameter that a launch file or command line gives. The node runs as long as nobody "
    "gives this one, and ends with an exception at start when somebody does.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters",),
    bad="#include <rclcpp/rclcpp.hpp>\nint main() {\n  rclcpp::NodeOptions options;\n"
    "  options.automatically_declare_parameters_from_overrides(true);\n"
    '  auto node = std::make_shared<rclcpp::Node>("arm", options);\n  node->declare_parameter("speed", 1.0);\n}\n',
    good="#include <rclcpp/rclcpp.hpp>\nint main() {\n"
    '  auto node = std::make_shared<rclcpp::Node>("arm");\n  node->declare_parameter("speed", 1.0);\n}\n',
    syntax="cpp",
    anchors=("automatically_declare_parameters_from_overrides",),
    mentions=RCLCPP,
    spares_tests=True,
    found=found,
)
