"""Rule ``cpp.reinterpret_cast``: memory that is read as something else."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such cast."""
    call = above(node, "call_expression", "compound_statement")
    text = view.short(call) if call is not None and call.type == "call_expression" else "reinterpret_cast"
    if node.type != "preproc_arg":
        yield view.hit("cpp.reinterpret_cast", node, f"`{text}`; expected std::memcpy, or a static_cast from void*")


RULE = FileRule(
    id="cpp.reinterpret_cast",
    title="`reinterpret_cast`",
    finds="`reinterpret_cast` reads memory as another type. Use `std::memcpy`, `std::bit_cast` or a serializer; "
    "`static_cast` from `void*`.",
    why="Alignment and byte order are those of this machine: the same bytes of a sensor are another number on "
    "the robot.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "misra-cpp-2023 8.2.5",
        "autosar-cpp14 A5-2-4",
        "hicpp 5.4.1",
        "clang-tidy cppcoreguidelines-pro-type-reinterpret-cast",
    ),
    bad="int* f(char* p) { return reinterpret_cast<int*>(p); }\n",
    good="int f(char* p) { int x; std::memcpy(&x, p, sizeof x); return x; }\n",
    syntax="cpp",
    anchors=("reinterpret_cast",),
    found=found,
)
