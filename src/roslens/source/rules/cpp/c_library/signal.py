"""Rule ``cpp.signal``: a handler of signals."""

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
            "cpp.signal",
            node,
            f"`{view.text(node)}` handles signals as C does; expected the shutdown of ROS, or a flag",
        )


RULE = FileRule(
    id="cpp.signal",
    title="Signal handling of C",
    finds="`signal` and `raise`: what a handler may call is next to nothing. Let ROS handle signals, or use "
    "`signalfd` or a `std::atomic` flag.",
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
        "misra-cpp-2008 18-7-1",
        "misra-cpp-2023 21.10.3",
        "autosar-cpp14 M18-7-1",
        "jsf-av 21",
    ),
    bad="void f() { signal(SIGINT, stop); }\n",
    good="void f() { rclcpp::on_shutdown(stop); }\n",
    syntax="cpp",
    anchors=(
        "signal",
        "raise",
        "sigaction",
    ),
    found=found,
)
