"""Rule ``cpp.header_function``: a function that every file with this header defines."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import function_declarator, name_node
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import GUARDED, Hit
from roslens.source.rules.rule import FileRule

_FREE = re.compile(rb"\b(?:inline|static|constexpr|consteval|template|[A-Z_]*INLINE[A-Z_]*|__inline\w*|friend)\b")

_DECLARED_INLINE = re.compile(rb"\b(?:inline|constexpr)\b[^;{}()]*?(~?\w+)\s*\([^;{}]*;")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each function with a body at the level of a namespace that has external linkage."""
    if not view.may_be_header or any(one.type == "ERROR" for one in view.root.children):
        return
    # A library in one header: one source file asks for what it defines.
    if b"_IMPLEMENTATION" in view.code:
        return
    for node in view.top_level:
        if node.type != "function_definition" or node.child_by_field_name("body") is None or node.has_error:
            continue
        function = function_declarator(node)
        name = view.text(name_node(function))
        if function is None or not _is_plain(name, function, view) or _is_inline(node, function, name, view):
            continue
        yield view.hit(
            "cpp.header_function",
            function,
            f"`{name}` is defined in every file that includes this header; expected `inline`",
            only=GUARDED,
            edits=_edits(node, view),
        )


def _is_plain(name: str, function: Node, view: FileView) -> bool:
    """Whether a function is neither a template's nor made by a macro nor a member in a piece of a class."""
    if not name or "<" in name or name.isupper() or name == "main":
        return False
    if any(one.type == "virtual_specifier" for one in function.children):
        return False
    # A piece that is read inside of a class of others, as the plug-ins of Eigen are.
    if "::" not in name:
        return not any(one.type == "type_qualifier" for one in function.children)
    return not _is_inline_inside(name, view)


def _is_inline(node: Node, function: Node, name: str, view: FileView) -> bool:
    """Whether what stands before a function says that each file has its own, or may say so."""
    body = node.child_by_field_name("body")
    start = max(view.code.rfind(b";", 0, node.start_byte), view.code.rfind(b"}", 0, node.start_byte)) + 1
    head = view.code[max(start, node.start_byte - 200) : body.start_byte if body is not None else node.end_byte]
    if _FREE.search(head) or _behind_macro(node, function, view):
        return True
    return node.child_by_field_name("type") is None and "::" not in name


def _behind_macro(node: Node, function: Node, view: FileView) -> bool:
    """Return whether a macro stands before the type, which may say ``inline``: ``CUDAH int offset()``."""
    # Macros are blanked in what was parsed, the file has them.
    start = view.content.rfind(b"\n", 0, node.start_byte) + 1
    before = view.content[start : function.start_byte].split()
    return len(before) > 1 and re.fullmatch(rb"[A-Z][A-Z0-9_]{2,}", before[0]) is not None


def _is_inline_inside(name: str, view: FileView) -> bool:
    """Return whether the class, in this file, declares a member function ``inline`` or ``constexpr``."""
    if view.words.isdisjoint((b"inline", b"constexpr")):
        return False
    return name.rpartition("::")[2].encode() in view.names(_DECLARED_INLINE)


def _edits(definition: Node, view: FileView) -> tuple[Edit, ...]:
    # In C `inline` means another thing.
    if view.root.has_error or not view.is_cpp_alone or "attribute" in definition.children[0].type:
        return ()
    return view.edits((definition.start_byte, definition.start_byte, "inline "))


RULE = FileRule(
    id="cpp.header_function",
    title="Function defined in a header without `inline`",
    finds="A function outside of classes, or a member defined outside of its class, with its body in a header, "
    "and neither `inline`, `static`, `constexpr` nor a template. Add `inline`, or move the body to a "
    "source file.",
    why="The second file that includes the header makes linking fail, with a message about a symbol and not "
    "about the header.",
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
    fix="Adds `inline`, in headers that C cannot read.",
    bad="#pragma once\nint twice(int x) { return 2 * x; }\n",
    good="#pragma once\ninline int twice(int x) { return 2 * x; }\n",
    syntax="cpp",
    whole=True,
    found=found,
)
