"""Rule ``python.argument_count``: a call of a function of the file with arguments that it does not take."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import function_around, is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import PythonClass, PythonFunctions, python_functions
from roslens.source.rules.flow.python_parameters import Parameter, parameters_of
from roslens.source.rules.flow.summary import Target
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_MAIN = re.compile(rb"^(?:if\s+__name__\b|while\b|rospy\.|rclpy\.|main\()", re.MULTILINE)
"""What a program has at its level, and a module that others import has not."""
_FALSE = frozenset({"0", "False"})


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call of one certain function that gives it an argument too few, too many or of another name."""
    functions = python_functions(view)
    for call in functions.calls:
        target = _target(call, functions, view)
        given = _given(call, view) if target is not None else None
        if target is None or given is None:
            continue
        problem = _problem(list(parameters_of(target.function, view)), target.bound, *given)
        if problem and not is_handled(call) and not _is_switched_off(call, view):
            line = target.function.start_point[0] + 1
            name = function_name(target.function, view)
            message = f"`{view.short(call)}` {problem} `{name}` (line {line}): a TypeError when this is reached"
            certainty = Certainty.HEURISTIC if _is_in_the_unused(call, view) else None
            yield view.hit("python.argument_count", call, message, certainty=certainty)


def _is_in_the_unused(call: Node, view: FileView) -> bool:
    """Tell whether a call stands in a function of the module whose name the code has nowhere else: it never runs."""
    function = function_around(call)
    if function is None or function.parent is None or function.parent.type != "module":
        return False
    name = re.escape(view.text(function.child_by_field_name("name")).encode())
    return len(re.findall(rb"\b%b\b" % name, view.code)) == 1 and _MAIN.search(view.code) is not None


def _is_switched_off(call: Node, view: FileView) -> bool:
    """Tell whether a call stands below a condition that is never true as it is written: ``if 0 and options.once``."""
    inner, outer = call, call.parent
    while outer is not None:
        if outer.type in ("if_statement", "elif_clause", "while_statement") and _is_of_body(inner, outer):
            condition = outer.child_by_field_name("condition")
            while condition is not None and condition.type == "boolean_operator":
                operator = condition.child_by_field_name("operator")
                condition = condition.child_by_field_name("left") if view.text(operator) == "and" else None
            if view.text(condition) in _FALSE:
                return True
        inner, outer = outer, outer.parent
    return False


def _is_of_body(inner: Node, outer: Node) -> bool:
    return inner in (outer.child_by_field_name("consequence"), outer.child_by_field_name("body"))


def _target(call: Node, functions: PythonFunctions, view: FileView) -> Target | None:
    """Return the one function that a call certainly calls."""
    callee = call.child_by_field_name("function")
    if callee is None or not _may_be_of_file(callee, functions, view):
        return None
    targets = functions.called(call)
    if len(targets) != 1 or not targets[0].is_exact or targets[0].function.type != "function_definition":
        return None
    target = targets[0]
    of = functions.class_around(target.function)
    if of is None or target.bound == 0:
        return target
    name = view.text(target.function.child_by_field_name("name"))
    if callee.type == "identifier":
        made = functions.class_of_name(callee)
        return target if made is not None and _is_plain_class(made, view) else None
    return None if functions.is_overridden(of, name) else target


def _is_plain_class(of: PythonClass, view: FileView) -> bool:
    """Tell whether making an object of a class calls its ``__init__`` with what it is given."""
    listed = view.text(of.node.child_by_field_name("superclasses"))
    return not ("__new__" in of.methods or "metaclass" in listed or _is_decorated(of.node))


def _may_be_of_file(callee: Node, functions: PythonFunctions, view: FileView) -> bool:
    if callee.type == "identifier":
        return functions.defines(view.text(callee))
    of = callee.child_by_field_name("object") if callee.type == "attribute" else None
    if of is None or of.type not in ("identifier", "attribute"):
        return False
    return functions.defines(view.text(callee.child_by_field_name("attribute")))


def _is_decorated(node: Node) -> bool:
    return node.parent is not None and node.parent.type == "decorated_definition"


def _given(call: Node, view: FileView) -> tuple[int, Sequence[str]] | None:
    """Return how many arguments a call gives by position, and the names of the others; None where nobody knows."""
    listed = call.child_by_field_name("arguments")
    if listed is None or listed.type != "argument_list":
        return None
    given = [one for one in listed.named_children if one.type not in ("comment", "line_continuation")]
    if any(one.type.endswith("_splat") for one in given):
        return None
    names = [view.text(one.child_by_field_name("name")) for one in given if one.type == "keyword_argument"]
    return len(given) - len(names), names


def _problem(parameters: Sequence[Parameter], bound: int, number: int, names: Sequence[str]) -> str:
    """Return what is wrong with the arguments of a call; empty where nothing is."""
    placed = [one for one in parameters if not one.by_name and not one.name.startswith("*")][bound:]
    kinds = {one.name for one in parameters}
    known = {one.name for one in parameters if not one.name.startswith("*")}
    if number > len(placed) and "*" not in kinds:
        return f"gives {number} argument{'s' * (number != 1)} by position, and at most {len(placed)} are taken by"
    unknown = next((one for one in names if one not in known), "") if "**" not in kinds else ""
    if unknown:
        return f"gives `{unknown}`, which is no parameter of"
    twice = next((one.name for one in placed[:number] if one.name in names), "")
    if twice:
        return f"gives `{twice}` twice to"
    needed = [*placed[number:], *(one for one in parameters if one.by_name and not one.name.startswith("*"))]
    missing = next((one.name for one in needed if not one.has_default and one.name not in names), "")
    return f"does not give `{missing}`, which has no default in" if missing else ""


RULE = FileRule(
    id="python.argument_count",
    title="Call with other arguments than the function takes (Python)",
    finds="A call of a function, method or class of the same file with an argument too few, too many, or of a name "
    "that it does not have. Calls with `*` or `**`, functions with decorators and methods that a class of the file "
    "overrides are left out. In a function of a program whose name stands nowhere else it is a note.",
    why="Python raises a TypeError when the line is reached, in a callback as much as at the start.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=(),
    clauses=("pylint E1120", "pylint E1121", "pylint E1123"),
    bad="""import rclpy
class Arm(Node):
    def tick(self):
        self.move(1.0, 2.0)
    def move(self, angle):
        self.angle = angle
""",
    good="""import rclpy
class Arm(Node):
    def tick(self):
        self.move(1.0)
    def move(self, angle):
        self.angle = angle
""",
    syntax="python",
    whole=True,
    mentions=ROS_PYTHON,
    found=found,
)
