"""Rule ``cpp.unnamed_namespace``: names without a namespace in a header."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import has_token
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import HEADER, Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each namespace without a name."""
    if node.child_by_field_name("name") is None and not has_token(node, "nested_namespace_specifier"):
        yield view.hit_at(
            "cpp.unnamed_namespace",
            view.place(node.start_byte)[0],
            "unnamed namespace in a header; expected a name such as `detail`",
            only=HEADER,
        )


RULE = FileRule(
    id="cpp.unnamed_namespace",
    title="Unnamed namespace in a header",
    finds="`namespace {` in a header: each file that includes it gets a copy of its own of all that is in it. "
    "Name it, for example `detail`.",
    why="A counter or cache in it exists once per file: what one part of the node sets another does not see.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "paper2016",
    ),
    tags=("header",),
    clauses=(
        "cpplint build/namespaces_headers",
        "misra-cpp-2008 7-3-3",
        "misra-cpp-2023 10.3.1",
        "autosar-cpp14 M7-3-3",
        "paper2016 unnamed_namespace",
        "clang-tidy google-build-namespaces",
    ),
    bad="#pragma once\nnamespace { int count(); }\n",
    good="#pragma once\nnamespace detail { int count(); }\n",
    syntax="cpp",
    kinds=("namespace_definition",),
    found=found,
)
