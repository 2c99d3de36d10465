"""Rule ``cpp.rethrow_by_name``: an exception that is thrown again as a copy."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each ``throw`` of the name that the handler around it caught."""
    if node.named_child_count != 1 or node.named_children[0].type != "identifier":
        return
    handler = above(node, "catch_clause", "lambda_expression", "function_definition")
    if handler is None or handler.type != "catch_clause":
        return
    for one in (handler.child_by_field_name("parameters") or handler).named_children:
        declarator = one.child_by_field_name("declarator")
        name = view.text(node.named_children[0])
        if (
            declarator is not None
            and declarator.type != "pointer_declarator"
            and view.text(name_node(declarator)).lstrip("&* ") == name
        ):
            thrown = node.named_children[0]
            word = next(one for one in node.children if one.type == "throw")
            # What cannot have been changed meanwhile is the same either way.
            is_firm = declarator.type == "reference_declarator" and "const" in view.text(one).split()
            yield view.hit(
                "cpp.rethrow_by_name",
                node,
                f"`throw {name};` throws a copy; expected `throw;`",
                edits=view.edits((word.end_byte, thrown.end_byte, "")) if is_firm else (),
            )


RULE = FileRule(
    id="cpp.rethrow_by_name",
    title="Exception thrown again by its name",
    finds="`throw e;` in the handler that caught `e`: the copy has the type that was caught, not the one that "
    "was thrown. Write `throw;`. It is a note where nothing in the package derives from a type of its own that was "
    "caught, or nothing in ROS from one of ROS.",
    why="Callers that handle a more special error, such as a timeout, no longer see it.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    fix="Writes `throw;` where the exception was caught by reference to const: it cannot have been changed.",
    bad="void f() { try { g(); } catch (const E& e) { throw e; } }\n",
    good="void f() { try { g(); } catch (const E& e) { throw; } }\n",
    syntax="cpp",
    kinds=("throw_statement",),
    found=found,
)
