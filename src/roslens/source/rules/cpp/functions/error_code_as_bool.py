"""Rule ``cpp.error_code_as_bool``: a function that returns true where it means that something failed."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_NUMBER = re.compile(r"-\s*\d+|[2-9]|[1-9]\d+")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each ``return`` of a number other than 0 and 1 from a function that returns ``bool``."""
    given = node.named_children[0] if node.named_child_count == 1 else None
    if given is None or given.type not in ("number_literal", "unary_expression"):
        return
    text = view.text(given)
    if _NUMBER.fullmatch(text) is None or text.lstrip("- ") == "0":
        return
    function = above(node, "lambda_expression", "function_definition")
    if function is None or function.type != "function_definition":
        return
    kind, declarator = function.child_by_field_name("type"), function.child_by_field_name("declarator")
    if view.text(kind) == "bool" and declarator is not None and declarator.type == "function_declarator":
        yield view.hit(
            "cpp.error_code_as_bool",
            node,
            f"`return {text};` in a function that returns `bool` returns true; expected `true` or `false`",
        )


RULE = FileRule(
    id="cpp.error_code_as_bool",
    title="Error code as bool",
    finds="A `return` of a number other than 0 and 1, such as `return -1;`, in a function that returns `bool`. Return "
    "`false`, or change the return type.",
    why="Every number but 0 is true: where the function means that a device could not be opened, its callers take it "
    "for a success.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1", "safety"),
    bad="bool open(const char * port) {\n  if (!found(port)) return -1;\n  return true;\n}\n",
    good="bool open(const char * port) {\n  if (!found(port)) return false;\n  return true;\n}\n",
    syntax="cpp",
    kinds=("return_statement",),
    mentions=("bool",),
    found=found,
)
