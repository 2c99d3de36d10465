"""Rule ``cpp.typedef``: a name for a type."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each typedef."""
    message = f"`{view.short(node)}`; expected `using`"
    yield view.hit("cpp.typedef", node, message, edits=_edits(node, view))


def _edits(node: Node, view: FileView) -> tuple[Edit, ...]:
    """Return what makes an alias of a typedef of one name, which ends with that name."""
    named = node.children_by_field_name("declarator")
    kind = node.child_by_field_name("type")
    if len(named) != 1 or kind is None or not view.is_cpp_alone or not view.is_as_written(node):
        return ()
    if kind.child_by_field_name("body") is not None or any(one.type == "comment" for one in below(node, "comment")):
        return ()
    name = named[0]
    while name.type in ("pointer_type_declarator", "reference_declarator", "pointer_declarator"):
        inner = name.child_by_field_name("declarator") or name.named_children[-1]
        name = inner
    begin, end = node.start_byte, node.end_byte
    text = view.content[begin:end].decode("utf-8", "replace")
    written = view.content[begin + len("typedef") : name.start_byte]
    if name.type != "type_identifier" or not text.startswith("typedef") or text[-1] != ";" or not written.isascii():
        return ()
    if view.content[name.end_byte : end - 1].strip():
        return ()
    aliased = written.decode().strip()
    return view.edits((begin, end - 1, f"using {view.text(name)} = {aliased}"))


RULE = FileRule(
    id="cpp.typedef",
    title="`typedef`",
    finds="`typedef`. Write `using Name = …;`.",
    why="AUTOSAR asks for it: `using` takes templates, and reads from left to right.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=("autosar-cpp14",),
    clauses=(
        "autosar-cpp14 A7-1-6",
        "clang-tidy modernize-use-using",
    ),
    fix="Writes `using`, where one name is declared and nothing stands behind it: no array, no pointer to a function.",
    bad="typedef int Count;\n",
    good="using Count = int;\n",
    syntax="cpp",
    kinds=("type_definition",),
    in_c=False,
    found=found,
)
