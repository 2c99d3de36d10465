"""Rule ``node.parameter_redeclared_python``: the same as ``node.parameter_redeclared``, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import (
    arguments,
    call_at,
    function_around,
    is_conditional,
    is_handled,
    receiver,
)
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_DECLARING = b"declare_parameter"


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a second declaration, and each in a class whose nodes declare whatever they are given."""
    if view.text(node) == _DECLARING.decode():
        return _twice(node, view)
    return _beside_overrides(node, view)


def _beside_overrides(node: Node, view: FileView) -> Iterator[Hit]:
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


def _twice(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a declaration of a name that the same function of the class has declared before it, in any case."""
    call = call_at(node)
    name = _declared(call, view)
    function = function_around(call) if call is not None else None
    if call is None or not name or function is None or is_handled(call) or is_conditional(call, function):
        return
    text = view.text(function)
    for other in python_functions(view).calls_in(function):
        if other.start_byte >= call.start_byte:
            return
        if _declared(other, view) == name and not is_conditional(other, function) and "undeclare" not in text:
            yield view.hit(
                "node.parameter_redeclared_python",
                call,
                f"parameter {name} is declared in line {other.start_point[0] + 1} already: "
                "ParameterAlreadyDeclaredException; expected one declaration",
                certainty=Certainty.PROVEN,
            )
            return


def _declared(call: Node | None, view: FileView) -> str:
    """Return the name, written out, that a call declares for the node itself."""
    if call is None or not view.text(call).startswith("self.declare_parameter("):
        return ""
    given = arguments(call)
    is_plain = given and given[0].type == "string" and not view.text(given[0]).startswith(("f", "F"))
    return view.text(given[0]).replace('"', "'") if is_plain else ""


RULE = FileRule(
    id="node.parameter_redeclared_python",
    title="Parameter declared a second time (Python)",
    finds="`self.declare_parameter` in a class that calls `super().__init__` with "
    "`automatically_declare_parameters_from_overrides=True`, without `has_parameter` before it and outside of `try`; "
    "and a second declaration of one name in a function, outside of conditions.",
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
    anchors=("automatically_declare_parameters_from_overrides", "declare_parameter"),
    mentions=RCLPY,
    spares_tests=True,
    found=found,
)
