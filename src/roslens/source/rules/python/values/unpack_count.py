"""Rule ``python.unpack_count``: values that are taken apart into another number of names."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import PythonFunctions, python_functions
from roslens.source.rules.flow.python_parts import is_plain
from roslens.source.rules.flow.python_returns import returns_of
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_PATTERNS = ("pattern_list", "tuple_pattern", "list_pattern")
_SCALARS = ("integer", "float", "true", "false", "none")
_SEQUENCES = ("list", "tuple")
_BLANK = ("comment", "line_continuation")
_RETURNED = ("expression_list", "tuple")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop over numbers, and an assignment of what a function of the file returns, with another count."""
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    if left is None or right is None or left.type not in _PATTERNS:
        return
    names = [one for one in left.named_children if one.type not in _BLANK]
    if any(one.type == "list_splat_pattern" for one in names) or is_handled(node):
        return
    if node.type == "for_statement":
        yield from _of_loop(right, len(names), view)
    elif right.type == "call":
        yield from _of_call(right, len(names), python_functions(view), view)


def _of_loop(right: Node, count: int, view: FileView) -> Iterator[Hit]:
    items = [one for one in right.named_children if one.type not in _BLANK] if right.type in _SEQUENCES else []
    if items and all(one.type in _SCALARS for one in items):
        yield view.hit(
            "python.unpack_count",
            right,
            f"`{view.short(right)}` holds single values, and each is taken apart into {count} names: a TypeError; "
            "expected `enumerate(…)`, or one name",
        )


def _of_call(call: Node, count: int, functions: PythonFunctions, view: FileView) -> Iterator[Hit]:
    targets = functions.called(call)
    if len(targets) != 1 or not targets[0].is_exact or targets[0].function.type != "function_definition":
        return
    function = targets[0].function
    of, name = functions.class_around(function), function_name(function, view).rpartition(".")[2]
    callee = call.child_by_field_name("function")
    if not is_plain(function, view) or (callee is not None and functions.class_of_name(callee) is not None):
        return
    if of is not None and functions.is_overridden(of, name):
        return
    returned = _returned(function, view)
    if returned is not None and returned != count:
        yield view.hit(
            "python.unpack_count",
            call,
            f"`{name}` (line {function.start_point[0] + 1}) returns {returned} values, and {count} names take them: a "
            f"ValueError when this is reached; expected {returned} names",
        )


def _returned(function: Node, view: FileView) -> int | None:
    """Return how many values all ways through a function return; None where that is open."""
    returns = returns_of(function, view)
    if returns.empty or returns.falls_off or returns.is_generator or not returns.values:
        return None
    if any(one.type == "async" for one in function.children):
        return None
    counts = {_count(one.named_children[0]) for one in returns.values}
    return counts.pop() if len(counts) == 1 else None


def _count(value: Node) -> int | None:
    if value.type not in _RETURNED or any(one.type == "list_splat" for one in value.named_children):
        return None
    return sum(one.type not in _BLANK for one in value.named_children)


RULE = FileRule(
    id="python.unpack_count",
    title="Values taken apart into another number of names",
    finds="`a, b = self.read()` where every `return` of that function of the file gives three values, and a loop with "
    "several names over a list of numbers: `for index, value in [1, 0]`. Take as many names as there are values, or "
    "use `enumerate`.",
    why="Python raises a ValueError or TypeError when the line is reached: the callback ends, and the node with it.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("values",),
    clauses=("pylint W0632",),
    bad="class Camera:\n    def read(self):\n        return self.color, self.depth, self.stamp\n\n"
    "    def tick(self):\n        color, depth = self.read()\n",
    good="class Camera:\n    def read(self):\n        return self.color, self.depth, self.stamp\n\n"
    "    def tick(self):\n        color, depth, stamp = self.read()\n",
    syntax="python",
    kinds=(
        "(assignment left: (pattern_list)) @node",
        "(assignment left: (tuple_pattern)) @node",
        "(for_statement left: (pattern_list)) @node",
    ),
    found=found,
)
