"""Rule ``cpp.errno_value``: an error that the next call overwrites."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each use of it."""
    if node.type == "identifier":
        yield view.hit("cpp.errno_value", node, "`errno`; expected a result, an exception or std::error_code")


RULE = FileRule(
    id="cpp.errno_value",
    title="`errno`",
    finds="`errno`. Use results, exceptions or `std::error_code`; where a system call leaves no choice, read it "
    "at once.",
    why="A log in between changes it, and the wrong cause is reported.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 19-3-1",
        "misra-cpp-2023 22.4.1",
        "autosar-cpp14 M19-3-1",
        "jsf-av 17",
        "paper2016 harosUsingErrno",
    ),
    bad="bool f() { return errno == 3; }\n",
    good="bool f(const std::error_code& code) { return !code; }\n",
    syntax="cpp",
    anchors=("errno",),
    found=found,
)
