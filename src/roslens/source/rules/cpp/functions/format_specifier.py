"""Rule ``cpp.format_specifier``: a format that not every platform knows."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_FORMAT = re.compile(rb'"[^"\n]*(%[-+ ]?\d*q|%\d+\$|\\\\[%\[({])[^"\n]*"')
_UNPORTABLE = re.compile(rb"%(?:[-+ ]?\d*q|\d+\$)")
_ESCAPED = re.compile(rb"\\\\[%\[({]")
"""Both are found sooner than the string that they stand in, as each begins with one byte."""
_CALL = re.compile(rb"printf|scanf|_LOG|ROS_|RCLCPP_|RCUTILS_")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each text on a line with a call that formats."""
    if not _ESCAPED.search(view.content) and not _UNPORTABLE.search(view.content):
        return
    for match in _FORMAT.finditer(view.content):
        line, column = view.place(match.start(1))
        node = view.node_at(match.start(1), match.end(1))
        if (
            node is not None
            and "string" in node.type + (node.parent.type if node.parent else "")
            and _CALL.search(view.lines[line - 1])
        ):
            yield view.hit_at(
                "cpp.format_specifier",
                line,
                f"`{match[1].decode('utf-8', 'replace')}` in a format; expected a portable one",
                column=column,
            )


RULE = FileRule(
    id="cpp.format_specifier",
    title="Format that depends on the platform",
    finds="`%qd` and positions such as `%1$d` in formats, and escapes that C++ does not have (`\\\\%`, `\\\\[`, "
    "`\\\\(`, `\\\\{`). Use `PRId64`, `std::format` or a stream.",
    why="The log of one computer of the robot shows other numbers than the log of another.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/printf_format",
        "cpplint build/printf_format",
        "paper2016 string_format",
        "paper2016 invalid_escape",
    ),
    bad='void f(int n) { printf("%qd", n); }\n',
    good='void f(int n) { printf("%d", n); }\n',
    syntax="cpp",
    whole=True,
    found=found,
)
