"""Rule ``cpp.delete_void``: an object that is deleted without its type."""

from __future__ import annotations

import re
from collections.abc import Iterator, Set
from typing import cast

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_TO_VOID = re.compile(rb"void\s*\*+\s*(?:const\s+)?([\w\x80-\xff]+)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a ``delete`` of a name that the file declares as a pointer to void, and as nothing else."""
    operand = node.named_children[-1] if node.named_child_count else None
    if operand is None or operand.type not in ("identifier", "cast_expression", "call_expression"):
        return
    text = view.text(operand)
    if operand.type == "identifier":
        is_void = text.encode() in _to_void(view) and _is_to_void(text.encode(), node, view)
    else:
        is_void = text.replace(" ", "").startswith(("(void*)", "static_cast<void*>", "reinterpret_cast<void*>"))
    if is_void:
        yield view.hit(
            "cpp.delete_void",
            node,
            f"`{view.text(node)}` of a `void*` runs no destructor; expected a pointer with its type",
        )


def _is_to_void(name: bytes, node: Node, view: FileView) -> bool:
    """Return whether a name is a pointer to void in the function around a node, or else all over the file."""
    function = above(node, "function_definition", "lambda_expression")
    code = view.code[function.start_byte : node.start_byte] if function is not None else b""
    word = re.escape(name)
    if re.search(rb"\bauto\b[^;=()]*\b%s\b|,\s*\*+\s*%s\b" % (word, word), code):
        return False
    pointer = re.compile(rb"(\w+)\s*\*+\s*(?:const\s+)?%s\b" % word)
    return set(pointer.findall(code) or pointer.findall(view.code)) == {b"void"}


def _to_void(view: FileView) -> Set[bytes]:
    """Return the names that a file declares as pointers to void."""
    found = view.kept.get("pointers to void")
    if found is None:
        found = view.kept["pointers to void"] = frozenset(_TO_VOID.findall(view.code))
    return cast("frozenset[bytes]", found)


RULE = FileRule(
    id="cpp.delete_void",
    title="`delete` of a pointer to void",
    finds="`delete p` of a `void*`: no destructor runs, and the behaviour is undefined. Keep the type.",
    why="What the object held (files, threads, devices) is never given back.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    clauses=("clang-tidy clang-diagnostic-delete-incomplete",),
    bad="void f(void* p) { delete p; }\n",
    good="void f(Driver* p) { delete p; }\n",
    syntax="cpp",
    kinds=("delete_expression",),
    found=found,
)
