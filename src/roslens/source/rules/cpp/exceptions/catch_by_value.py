"""Rule ``cpp.catch_by_value``: a handler that copies what it catches."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_KNOWN = re.compile(
    r"std::(?:\w+_error|exception|bad_\w+|out_of_range|invalid_argument|future_error|runtime_error)$"
    r"|(?:tf2?|ros|rclcpp|rclcpp::exceptions|image_transport|cv_bridge|pluginlib|class_loader|YAML|rosbag|cv)::\w+$"
)
"""Classes whose `what()` is const, as that of `std::exception` is."""
_KEEPS_NOTHING = re.compile(r"(?:std::)?exception$")
"""A class whose copy says nothing of what was thrown; copies of others keep the text they were made with."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each parameter of a handler that is of a class and no reference."""
    for one in (node.child_by_field_name("parameters") or node).named_children:
        kind = one.child_by_field_name("type") if one.type == "parameter_declaration" else None
        if kind is None or kind.type in ("primitive_type", "sized_type_specifier"):
            continue
        declarator = one.child_by_field_name("declarator")
        if declarator is None or declarator.type == "identifier":
            text = view.text(kind)
            yield view.hit(
                "cpp.catch_by_value",
                one,
                f"`catch ({view.text(one)})` copies the exception; expected `const {text}&`",
                certainty=None if _KEEPS_NOTHING.match(text) else Certainty.HEURISTIC,
                edits=_edits(node, one, kind, view),
            )


def _edits(handler: Node, parameter: Node, kind: Node, view: FileView) -> tuple[Edit, ...]:
    """Return what makes a parameter a reference to const, where its handler asks it for nothing but `what()`."""
    body, named = handler.child_by_field_name("body"), parameter.child_by_field_name("declarator")
    if body is None or not _KNOWN.match(view.text(kind)) or not view.is_as_written(parameter):
        return ()
    if named is not None:
        word = re.escape(view.text(named).encode())
        uses = re.findall(rb"\b%s\b(\s*\.\s*what\s*\(\s*\))?" % word, view.code[body.start_byte : body.end_byte])
        if not all(uses):
            return ()
    is_const = any(one.type == "type_qualifier" for one in parameter.children)
    return view.edits(
        *(() if is_const else ((parameter.start_byte, parameter.start_byte, "const "),)),
        (kind.end_byte, kind.end_byte, "&" if named is not None else " &"),
    )


RULE = FileRule(
    id="cpp.catch_by_value",
    title="Exception caught by value",
    finds="`catch (E e)` of a class: the exception is copied, and what a derived class added is cut off. Catch "
    "by `const E&`. What is copied of `std::exception` has lost its text; others keep theirs, and are notes.",
    why="The message of the error that mattered is lost in the log: `std::exception` alone says nothing.",
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
        "misra-cpp-2008 15-3-5",
        "misra-cpp-2023 18.3.2",
        "autosar-cpp14 A15-3-5",
        "clang-tidy misc-throw-by-value-catch-by-reference",
    ),
    fix="Catches by `const E&` where the class is a known one and the handler asks it for `what()` only.",
    bad="void f() { try { g(); } catch (std::exception e) { log(e.what()); } }\n",
    good="void f() { try { g(); } catch (const std::exception& e) { log(e.what()); } }\n",
    syntax="cpp",
    kinds=("catch_clause",),
    found=found,
)
