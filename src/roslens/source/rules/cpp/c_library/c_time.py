"""Rule ``cpp.c_time``: time by the functions of C."""

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
            "cpp.c_time", node, f"`{view.text(node)}` is a time function of C; expected std::chrono or the clock of ROS"
        )


RULE = FileRule(
    id="cpp.c_time",
    title="Time functions of C",
    finds="Functions of `<ctime>`: `time`, `clock`, `mktime`, `difftime`. Use `std::chrono` or the clock of ROS.",
    why="A standard for safety-related software asks for it; on a robot it matters where the process must not "
    "stop or change its timing.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 18-0-4",
        "autosar-cpp14 M18-0-4",
        "jsf-av 25",
    ),
    bad="void f() { long t = time(nullptr); }\n",
    good="void f() { auto t = std::chrono::steady_clock::now(); }\n",
    syntax="cpp",
    anchors=(
        "mktime",
        "difftime",
        "clock",
        "time",
    ),
    found=found,
)
