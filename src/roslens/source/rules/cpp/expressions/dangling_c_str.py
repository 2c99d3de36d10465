"""Rule ``cpp.dangling_c_str``: a pointer into a text that is gone."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.code_pattern import places
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_C_STR = re.compile(rb"\)\s*\.\s*(?:c_str|data)\s*(\()\s*\)\s*;")
_MAKES = re.compile(
    r"(?:\.|->)(?:str|string|toStdString|substr)\(\)$|^(?:std::)?(?:to_string|string)\(|^\(.*\+.*\)$|\.substr\([^()]*\)$"
)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each pointer that is set to the characters of a temporary."""
    for match, node in places(_C_STR, view, 1):
        call = node if node.type == "call_expression" else above(node, "call_expression")
        callee = call.child_by_field_name("function") if call is not None else None
        text = view.text(callee.child_by_field_name("argument")) if callee is not None else ""
        around = call.parent if call is not None else None
        if around is None or not _MAKES.search(text) or _may_refer(text, match[0], view):
            continue
        target = around.child_by_field_name("declarator")
        if around.type == "init_declarator" and target is not None and target.type == "pointer_declarator":
            name = view.text(name_node(target))
            yield view.hit(
                "cpp.dangling_c_str",
                around,
                f"`{name}` points into `{shortened(text, 60)}`, which is gone; expected a `std::string {name}`",
            )


def _may_refer(text: str, call: bytes, view: FileView) -> bool:
    """Return whether what is called may give back a reference or a view: a path of Boost, a part of a string_view."""
    if text.endswith("string()") and view.mentions((b"boost",)):
        return True
    return ".substr(" in text and b"data" in call and view.mentions((b"string_view",))


RULE = FileRule(
    id="cpp.dangling_c_str",
    title="Pointer into a text that is gone",
    finds="`const char* p = s.str().c_str();`: the temporary string dies at the semicolon. Keep the `std::string`.",
    why="The pointer works in tests and reads freed memory in the field: wrong frame names, wrong device paths.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    clauses=("clang-tidy bugprone-dangling-handle",),
    bad="void f(std::ostringstream& s) { const char* p = s.str().c_str(); }\n",
    good="void f(std::ostringstream& s) { std::string p = s.str(); }\n",
    syntax="cpp",
    whole=True,
    words=("c_str", "data"),
    found=found,
)
