"""Rule ``cpp.header_variable``: a variable that every file with this header defines."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import HEADER, Hit
from roslens.source.rules.rule import FileRule

_CONSTANT = ("const", "constexpr", "constinit")
_FREE = ("extern", "inline", "thread_local")
_MACRO_LIKE = re.compile(r"[A-Z][A-Z0-9_]*")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each variable that is defined at the level of a namespace and may change."""
    if not view.may_be_header or any(one.type == "ERROR" for one in view.root.children):
        return
    for node in view.top_level:
        if node.type != "declaration" or node.has_error:
            continue
        words = [view.text(one) for one in node.children if one.type in ("type_qualifier", "storage_class_specifier")]
        kind = view.text(node.child_by_field_name("type"))
        # A macro that was taken out for the parse may stand for `extern`.
        line = view.lines[view.place(node.start_byte)[0] - 1]
        begins_with_macro = re.match(rb"\s*[A-Z][A-Z0-9_]{3,}\s", line)
        if any(one in words for one in (*_CONSTANT, *_FREE)) or not kind or begins_with_macro:
            continue
        for one in node.children_by_field_name("declarator"):
            name = _variable(one, view)
            if name:
                message = (
                    f"every file that includes this header defines `{name}`; expected `extern`, `inline` or `const`"
                )
                yield view.hit("cpp.header_variable", node, message, only=HEADER)
                break


def _variable(declarator: Node, view: FileView) -> str:
    """Return the name of a variable that is not const; empty for a function, a constant or a member."""
    text = view.text(declarator)
    if function_declarator_in(declarator) or re.search(r"\*\s*const\b", text):
        return ""
    name = view.text(name_node(declarator))
    # Members of a class whose head the parse could not read begin or end so.
    is_member = name.startswith("_") or name.endswith("_")
    return name if name.isidentifier() and not is_member and not _MACRO_LIKE.fullmatch(name) else ""


def function_declarator_in(declarator: Node) -> bool:
    """Return whether a declarator declares a function, or a reference or pointer to what it returns."""
    one: Node | None = declarator
    while one is not None:
        if one.type in ("function_declarator", "parenthesized_declarator", "qualified_identifier"):
            return True
        one = one.child_by_field_name("declarator") or next(
            (x for x in one.named_children if x.type.endswith("declarator")), None
        )
    return False


RULE = FileRule(
    id="cpp.header_variable",
    title="Variable defined in a header",
    finds="A variable at the level of a file or namespace in a header, neither `const`, `constexpr`, `inline`, "
    "`extern` nor a template. Declare it `extern` and define it in one source file, or make it `inline`.",
    why="With two files it does not link; as `static` each file has a variable of its own, and one node sees "
    "two states.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    tags=("header",),
    clauses=(
        "misra-cpp-2008 3-1-1",
        "autosar-cpp14 A3-1-1",
        "jsf-av 39",
        "clang-tidy misc-definitions-in-headers",
    ),
    bad="#pragma once\nint counter = 0;\n",
    good="#pragma once\nextern int counter;\n",
    syntax="cpp",
    whole=True,
    found=found,
)
