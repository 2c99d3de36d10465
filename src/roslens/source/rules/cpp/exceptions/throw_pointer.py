"""Rule ``cpp.throw_pointer``: an exception that is thrown as a pointer."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each ``throw`` of what ``new`` made."""
    if node.named_child_count and (thrown := node.named_children[0]).type == "new_expression":
        kind = view.text(thrown.child_by_field_name("type"))
        yield view.hit("cpp.throw_pointer", node, f"`throw new {kind}` throws a pointer; expected `throw {kind}(…)`")


RULE = FileRule(
    id="cpp.throw_pointer",
    title="Exception thrown as a pointer",
    finds="`throw new E(…)`: it is unclear who deletes it, and `catch (const E&)` does not see it. Throw the "
    "object itself. It is a note where a handler of the package catches pointers of that type.",
    why="The handler that was meant to stop the robot does not match, and the process ends.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 15-0-2",
        "misra-cpp-2023 18.1.1",
        "autosar-cpp14 A15-1-2",
        "clang-tidy misc-throw-by-value-catch-by-reference",
    ),
    bad="void f() { throw new Error(3); }\n",
    good="void f() { throw Error(3); }\n",
    syntax="cpp",
    kinds=("throw_statement",),
    found=found,
)
