"""Rule ``node.parameter_redeclared_python``: the same as ``node.parameter_redeclared``, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, function_around, is_handled, receiver
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_DECLARING = b"declare_parameter"


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each declaration of a parameter in a class whose nodes declare whatever they are given."""
    given = node.parent
    made = above(node, "call")
    around = above(node, "class_definition")
    if given is None or given.type != "keyword_argument" or made is None or around is None:
        return
    if view.text(given.child_by_field_name("value")) != "True" or "super(" not in view.text(receiver(made)):
        return
    for at in word_places(_DECLARING, view, around.start_byte, around.end_byte):
        word = view.node_at(at, at + len(_DECLARING))
        declaring = call_at(word) if word is not None else None
        if declaring is None or view.text(receiver(declaring)) != "self" or not arguments(declaring):
            continue
        function = function_around(declaring)
        before = view.code[function.start_byte : declaring.start_byte] if function is not None else b""
        if b"has_parameter" in before or is_handled(declaring):
            continue
        yield view.hit(
            "node.parameter_redeclared_python",
            declaring,
            f"parameter {view.short(arguments(declaring)[0])} is declared, and the node declares whatever it is given "
            f"(line {given.start_point[0] + 1}): ParameterAlreadyDeclaredException as soon as a launch file sets it; "
            "expected `has_parameter` to be asked before, or the option to be left out",
        )


RULE = FileRule(
    id="node.parameter_redeclared_python",
    title="Parameter declared a second time (Python)",
    finds="`self.declare_parameter` in a class that calls `super().__init__` with "
    "`automatically_declare_parameters_from_overrides=True`, without `has_parameter` before it and outside of `try`.",
    why="The option declares every parameter that a launch file or command line gives. The node runs as long as nobody "
    "gives this one, and ends with an exception at start when somebody does.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters",),
    bad="import rclpy\n\n\nclass Arm(Node):\n\n    def __init__(self):\n"
    "        super().__init__('arm', automatically_declare_parameters_from_overrides=True)\n"
    "        self.declare_parameter('speed', 1.0)\n",
    good="import rclpy\n\n\nclass Arm(Node):\n\n    def __init__(self):\n        super().__init__('arm')\n"
    "        self.declare_parameter('speed', 1.0)\n",
    syntax="python",
    anchors=("automatically_declare_parameters_from_overrides",),
    mentions=RCLPY,
    spares_tests=True,
    found=found,
)
