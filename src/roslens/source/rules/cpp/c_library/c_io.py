"""Rule ``cpp.c_io``: input and output by the functions of C."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import free_call
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call of one of these functions."""
    if free_call(node, view) is not None:
        yield view.hit(
            "cpp.c_io", node, f"`{view.text(node)}` is input or output of C; expected a stream or the logger"
        )


RULE = FileRule(
    id="cpp.c_io",
    title="Input and output of C",
    finds="Functions of `<cstdio>`. Use streams, or the logger.",
    why="A standard for safety-related software asks for it; on a robot it matters where the process must not "
    "stop or change its timing.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 27-0-1",
        "misra-cpp-2023 30.0.1",
        "autosar-cpp14 M27-0-1",
        "jsf-av 22",
        "clang-tidy cppcoreguidelines-pro-type-vararg",
    ),
    bad='void f() { printf("a"); }\n',
    good='void f() { std::cout << "a"; }\n',
    syntax="cpp",
    anchors=(
        "printf",
        "fprintf",
        "scanf",
        "fscanf",
        "sscanf",
        "fopen",
        "fclose",
        "fread",
        "fwrite",
        "puts",
        "putchar",
        "fputs",
        "fgets",
        "getchar",
        "vprintf",
        "vfprintf",
        "perror",
        "remove_never",
    ),
    in_c=False,
    found=found,
)
