"""Rule ``node.parameter_undeclared_python``: a parameter that is read and that nothing declares, in rclpy."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, function_around, is_handled, receiver
from roslens.source.rules.file_view import FileView, above, below
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.parameters.declared_names_python import declared_names
from roslens.source.rules.node.parameters.undeclared import declares_nothing, is_always_there
from roslens.source.rules.rule import RCLPY, FileRule

_QUOTES = ("'", '"')
_NODES = ("(Node)", "(rclpy.node.Node)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a read of a parameter by a node of a file that declares nothing."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or len(given) != 1 or is_always_there(view.text(given[0])):
        return
    name = view.text(given[0])
    if not declares_nothing(view):
        yield from _among_others(call, given[0], view)
    elif _is_node(receiver(call), call, view):
        yield view.hit(
            "node.parameter_undeclared_python",
            call,
            f"parameter `{name}` is declared nowhere in this file, so that `get_parameter` raises "
            f"ParameterNotDeclaredException; expected `declare_parameter({name}, …)` before it",
        )


def _among_others(call: Node, given: Node, view: FileView) -> Iterator[Hit]:
    """Yield a read of a name that is none of those that the class declares, all of which are known."""
    functions = python_functions(view)
    of = functions.class_around(call)
    if of is None or view.text(given)[:1] not in _QUOTES or not functions.is_self(receiver(call)) or is_handled(call):
        return
    declared = declared_names(of, functions, view)
    name = view.text(given).strip("'\"")
    function = function_around(call)
    asks = function is not None and "has_parameter" in view.text(function)
    if declared and name not in declared and not asks:
        near = get_close_matches(name, sorted(declared), 1, 0.5)
        expected = f"`'{near[0]}'`" if near else f"`declare_parameter('{name}', …)` before it"
        yield view.hit(
            "node.parameter_undeclared_python",
            call,
            f"parameter '{name}' is none of those that `{of.name}` declares, so that `get_parameter` raises "
            f"ParameterNotDeclaredException; expected {expected}",
        )


def _is_node(one: Node | None, call: Node, view: FileView) -> bool:
    """Return whether an object is a node whose parameters this file alone declares."""
    name = view.text(one)
    if name == "self":
        around = above(call, "class_definition")
        if around is None or view.text(around.child_by_field_name("superclasses")) not in _NODES:
            return False
        return _is_early(call, around, view)
    made = rf"\b{re.escape(name)}\s*=\s*rclpy\.create_node\("
    return re.fullmatch(r"(?:self\.)?\w+", name) is not None and re.search(made.encode(), view.code) is not None


def _is_early(call: Node, around: Node, view: FileView) -> bool:
    """Return whether a call stands in ``__init__``, or in a method that it calls: others may declare later on."""
    function = above(call, "function_definition")
    name = _name(function, view) if function is not None else ""
    if name == "__init__":
        return True
    first = next((one for one in below(around, "function_definition") if _name(one, view) == "__init__"), None)
    return bool(name) and first is not None and f"self.{name}(" in view.text(first)


def _name(function: Node, view: FileView) -> str:
    return view.text(function.child_by_field_name("name"))


RULE = FileRule(
    id="node.parameter_undeclared_python",
    title="Parameter read and not declared (rclpy)",
    finds="`get_parameter` in the constructor of a class derived from `Node` alone, or of a node that "
    "`rclpy.create_node` makes, in a file that declares no parameter at all and sets neither "
    "`allow_undeclared_parameters` nor `automatically_declare_parameters_from_overrides`; and of a name that is none "
    "of those which such a class declares, where all of these are written out.",
    why="Since ROS 2 Dashing only declared parameters exist: `get_parameter` raises ParameterNotDeclaredException, "
    "also where a parameter file gives a value. Mostly the node ends at start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters",),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.limit = self.get_parameter('limit').value
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.limit = self.declare_parameter('limit', 0.5).value
""",
    syntax="python",
    anchors=("get_parameter",),
    mentions=RCLPY,
    spares_tests=True,
    found=found,
)
