"""Rule ``cpp.variable_length_array``: an array whose length is known at run time only."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.cpp_class import function_declarator, name_node, parameters_of
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FIRMWARE, FileRule

_MAY_VARY = re.compile(r"[a-z]")
"""Of what a length that varies has a letter: the name of a variable or of a function."""
_KEYWORD = re.compile(r"\b(?:class|new|this|template|namespace|typename)\b")

_FIRMWARE = (*FIRMWARE, b"Arduino.h")
"""What code for microcontrollers mentions, whose library has no ``std::vector``."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each local array whose length is a parameter, a call of ``size`` or a local variable that may change."""
    size = node.child_by_field_name("size")
    text = view.text(size)
    # What stands around a node is asked from the root of the tree on; most lengths are numbers or constants.
    if size is None or not _MAY_VARY.search(text) or view.mentions(_FIRMWARE):
        return
    parent = node.parent
    while parent is not None and parent.type in ("init_declarator", "array_declarator", "pointer_declarator"):
        parent = parent.parent
    if parent is None or parent.type != "declaration" or node.has_error:
        return
    function = above(node, "function_definition", "lambda_expression", "class_specifier", "struct_specifier")
    if function is None or function.type != "function_definition":
        return
    if _KEYWORD.search(text):  # a name that only C allows: what stands here is no declaration
        return
    inner = node.child_by_field_name("declarator")
    length = inner.child_by_field_name("size") if inner is not None and inner.type == "array_declarator" else None
    if not _varies(text, function, view) or (length is not None and _varies(view.text(length), function, view)):
        return  # of an array of arrays one length says enough
    name = view.text(name_node(node))
    yield view.hit(
        "cpp.variable_length_array",
        node,
        f"`{name}` has `{shortened(text, 40)}` elements, known at run time only; expected a std::vector",
    )


def _varies(text: str, function: Node, view: FileView) -> bool:
    if re.search(r"(?:\.|->)(?:size|length)\(\)|\bstrlen\(", text):
        return "sizeof" not in text
    if not (words := re.findall(r"\b[a-z]\w*\b", text)) or "sizeof" in words or "::" in text or "<" in text:
        return False
    declarator = function_declarator(function)
    parameters = parameters_of(declarator) if declarator is not None else []
    names = {view.text(name_node(one.child_by_field_name("declarator"))).lstrip("&* ") for one in parameters}
    return any(word in names for word in words)


RULE = FileRule(
    id="cpp.variable_length_array",
    title="Array of variable length",
    finds="An array on the stack whose length is a parameter or a result of a call. "
    "It is no C++, though C has it, and a large length overruns the stack. Use `std::vector`. "
    "Code for microcontrollers, which have none, is let be.",
    why="A large scan or image ends the node with a segmentation fault, without any message.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/arrays",
        "paper2016 variable_length_array",
        "clang-tidy clang-diagnostic-vla",
    ),
    bad="void f(int n) { double ranges[n]; }\n",
    good="void f(int n) { std::vector<double> ranges(n); }\n",
    syntax="cpp",
    kinds=("array_declarator",),
    in_c=False,
    found=found,
)
