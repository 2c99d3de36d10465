"""Rule ``cpp.copy_macro``: a macro for what the language says."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import enclosing_class
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each use of such a macro that is not private."""
    if node.type not in ("identifier", "type_identifier", "field_identifier"):
        return
    cls = enclosing_class(node)
    if cls is None:
        return
    before = view.code[cls.start_byte : node.start_byte]
    places = {word: before.rfind(word) for word in (b"public:", b"protected:", b"private:")}
    last = max(places, key=lambda word: places[word])
    if (cls.type == "struct_specifier" and places[last] < 0) or (places[last] >= 0 and last != b"private:"):
        yield view.hit(
            "cpp.copy_macro", node, f"`{view.text(node)}` is not private; expected `= delete`, or the private part"
        )


RULE = FileRule(
    id="cpp.copy_macro",
    title="Macro that forbids copies",
    finds="`DISALLOW_COPY_AND_ASSIGN` and its like outside of the private part of a class. Write `= delete`, or "
    "put the macro last among what is private.",
    why="The message of the compiler is about the macro, not about the copy.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/constructors",
        "paper2016 disallow_in_private",
        "paper2016 disallow_macro",
    ),
    bad="class A {\n public:\n  DISALLOW_COPY_AND_ASSIGN(A);\n};\n",
    good="class A {\n public:\n  A(const A&) = delete;\n};\n",
    syntax="cpp",
    anchors=(
        "DISALLOW_COPY_AND_ASSIGN",
        "DISALLOW_IMPLICIT_CONSTRUCTORS",
        "DISALLOW_ASSIGN",
        "DISALLOW_COPY",
    ),
    found=found,
)
