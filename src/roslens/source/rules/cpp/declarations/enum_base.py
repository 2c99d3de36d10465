"""Rule ``cpp.enum_base``: an enumeration that does not say its size."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each enumeration that does not say its type."""
    if node.child_by_field_name("base") is None and node.child_by_field_name("body") is not None:
        yield view.hit(
            "cpp.enum_base", node, "the enumeration does not say its type; expected `: uint8_t` or another one"
        )


RULE = FileRule(
    id="cpp.enum_base",
    title="Enumeration without a type",
    finds="An `enum` without an underlying type. Write `enum class Mode : uint8_t`.",
    why="What is written into a message or to a device has another size on another compiler.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
        "paper2016",
    ),
    clauses=(
        "hicpp 7.2.1",
        "misra-cpp-2023 10.2.1",
        "autosar-cpp14 A7-2-2",
        "paper2016 harosEnumWithoutBase",
    ),
    bad="enum Mode { ON, OFF };\n",
    good="enum Mode : uint8_t { ON, OFF };\n",
    syntax="cpp",
    kinds=("enum_specifier",),
    in_c=False,
    found=found,
)
