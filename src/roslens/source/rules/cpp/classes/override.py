"""Rule ``cpp.override``: a function that overrides another without saying so."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import cast

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import bases_of, class_name, is_static, members_of, name_node, parameters_of
from roslens.source.rules.edits.override_edits import override_edits
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each function that overrides one of a base class in this file."""
    bases = {one.partition("<")[0].rpartition("::")[2] for one in bases_of(node, view)}
    if not bases:
        return
    inherited = _virtual_in(bases, node.start_byte, view)
    for member in members_of(node, view):
        if member.declarator is None or member.is_override or member.name not in inherited or is_static(member.node):
            continue
        if _key(member.declarator, view) in inherited[member.name]:
            yield view.hit(
                "cpp.override",
                member.declarator,
                f"`{view.short(member.declarator)}` overrides; expected `override`",
                edits=override_edits(member.node, member.declarator, view),
            )


def _virtual_in(bases: Collection[str], before: int, view: FileView) -> dict[str, set[int]]:
    """Return the virtual functions of classes that stand before a place: their keys, by name."""
    found: dict[str, set[int]] = {}
    by_name = _by_name(view)
    for other in (one for name in bases for one in by_name.get(name, ()) if one.start_byte < before):
        for member in members_of(other, view):
            if member.declarator is not None and member.is_virtual and not member.name.startswith("~"):
                found.setdefault(member.name, set()).add(_key(member.declarator, view))
    return found


def _by_name(view: FileView) -> Mapping[str, Sequence[Node]]:
    """Return the classes of a file by their name."""
    known = view.kept.get("classes by name")
    if known is None:
        found: dict[str, list[Node]] = {}
        for one in _classes(view):
            found.setdefault(class_name(one, view), []).append(one)
        known = view.kept["classes by name"] = found
    return cast("Mapping[str, Sequence[Node]]", known)


def _key(declarator: Node, view: FileView) -> int:
    is_const = any(one.type == "type_qualifier" for one in declarator.children)
    types = tuple(_type(one, view) for one in parameters_of(declarator))
    return hash((is_const, types))


def _type(parameter: Node, view: FileView) -> str:
    named = name_node(parameter.child_by_field_name("declarator"))
    end = named.start_byte if named is not None and named.type == "identifier" else parameter.end_byte
    return "".join(view.source[parameter.start_byte : end].decode("utf-8", "replace").split())


def _classes(view: FileView) -> Iterator[Node]:
    for node in view.top_level:
        if node.type in ("class_specifier", "struct_specifier"):
            yield node
        elif node.type == "template_declaration":
            yield from (one for one in node.named_children if one.type in ("class_specifier", "struct_specifier"))


RULE = FileRule(
    id="cpp.override",
    title="Overriding function without `override`",
    finds="A virtual function that a base class in the same file declares with the same name and as many "
    "parameters, without `override`. Add `override`.",
    why="When the base class changes a parameter, the function silently is a new one, and the safe default of "
    "the base runs.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "hicpp 10.2.1",
        "misra-cpp-2023 13.3.1",
        "autosar-cpp14 A10-3-2",
        "clang-tidy modernize-use-override",
    ),
    fix="Adds `override`, and takes away `virtual`, which it says too.",
    bad="struct A { virtual void stop(); };\nstruct B : A { void stop(); };\n",
    good="struct A { virtual void stop(); };\nstruct B : A { void stop() override; };\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier"),
    found=found,
)
