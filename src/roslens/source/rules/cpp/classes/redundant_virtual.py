"""Rule ``cpp.redundant_virtual``: a word that `override` says already."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import has_token, name_node
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.spans import with_space


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each declaration that says twice that it is virtual."""
    declarator = node.parent
    if declarator is None or declarator.type != "function_declarator":
        return
    words = [view.text(one) for one in declarator.children if one.type == "virtual_specifier"]
    around = above(declarator, "field_declaration", "declaration", "function_definition")
    if (
        words
        and view.text(node) == words[0]
        and around is not None
        and (has_token(around, "virtual") or len(words) > 1)
    ):
        both = ["virtual"] * has_token(around, "virtual") + words
        yield view.hit(
            "cpp.redundant_virtual",
            declarator,
            f"`{'` and `'.join(both)}` of `{view.text(name_node(declarator))}`; expected one of them",
            edits=_edits(around, declarator, view) if "override" in words else (),
        )


def _edits(declaration: Node, declarator: Node, view: FileView) -> tuple[Edit, ...]:
    gone = [one for one in declaration.children if one.type == "virtual"]
    specifiers = [one for one in declarator.children if one.type == "virtual_specifier"]
    if len(specifiers) > 1:
        gone += [one for one in specifiers if view.text(one) == "override"]
    return view.edits(*((*with_space(view.content, one.start_byte, one.end_byte), "") for one in gone))


RULE = FileRule(
    id="cpp.redundant_virtual",
    title="`virtual` beside `override`",
    finds="`virtual` together with `override` or `final`, or `override` with `final`. One of them says it all.",
    why="Each word more makes it harder to see the one that is missing elsewhere.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "misra-cpp-2023",
        "autosar-cpp14",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/inheritance",
        "autosar-cpp14 A10-3-1",
        "misra-cpp-2023 13.3.1",
        "paper2016 redundant_virtual_decl",
        "paper2016 redundant_override_decl",
        "clang-tidy modernize-use-override",
    ),
    unlike=("cpp.missing_virtual",),
    fix="Keeps the word that says most, `final` or `override`. `virtual` beside `final` alone is left: it may "
    "begin something.",
    bad="struct B : A { virtual void stop() override; };\n",
    good="struct B : A { void stop() override; };\n",
    syntax="cpp",
    kinds=("virtual_specifier",),
    found=found,
)
