"""Rule ``cpp.delete_form``: memory that is freed in another form than it was taken."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.calls import function_around
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import has_token
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_NEW = re.compile(rb"\s*(?:=|\()\s*new\b([^;]*)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a ``delete`` whose operand the file gets by the other form of ``new`` and only by that."""
    operand = node.named_children[-1] if node.named_child_count else None
    if operand is None or operand.type not in ("identifier", "field_expression"):
        return
    name = view.text(operand)
    word = re.split(r"->|\.|::", name)[-1].encode()
    places = list(word_places(word, view)) if b"new" in view.words else []
    function = function_around(node)
    if operand.type == "identifier" and function is not None and _is_declared_in(function, word, view):
        places = [at for at in places if function.start_byte <= at < function.end_byte]
    gets = (_NEW.match(view.code, at + len(word)) for at in places)
    forms = {b"[" in _made(match[1]) for match in gets if match is not None}
    is_array = has_token(node, "[")
    if forms == {not is_array}:
        form = "delete" if is_array else "delete[]"
        yield view.hit(
            "cpp.delete_form",
            node,
            f"`{view.text(node)}`, but `{name}` is made by `new{'' if is_array else '[]'}`; expected `{form} {name}`",
        )


def _is_declared_in(function: Node, name: bytes, view: FileView) -> bool:
    """Return whether a function has a pointer of its own of a name, whatever others do with one of that name."""
    declared = re.compile(rb"\w\s*\*+\s*(?:const\s+)?%s\s*[=;,{(]" % re.escape(name))
    return declared.search(view.code, function.start_byte, function.end_byte) is not None


def _made(text: bytes) -> bytes:
    """Return what stands before the arguments of a constructor."""
    placed = text.lstrip()
    if placed.startswith(b"("):
        placed = placed.partition(b")")[2]
    return re.split(rb"[({]", placed)[0].replace(b"[]>", b"")


RULE = FileRule(
    id="cpp.delete_form",
    title="`delete` of an array, or `delete[]` of one object",
    finds="`delete p` where the file has `p = new T[…]`, or `delete[] p` where it has `p = new T`. Use the form "
    "that belongs to it, or `std::vector`.",
    why="The heap is damaged; the node ends somewhere else, long after.",
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "hicpp 5.3.3",
        "autosar-cpp14 A18-5-3",
        "clang-tidy clang-analyzer-unix.MismatchedDeallocator",
    ),
    bad="void f() { char* p = new char[3]; delete p; }\n",
    good="void f() { char* p = new char[3]; delete[] p; }\n",
    syntax="cpp",
    kinds=("delete_expression",),
    found=found,
)
