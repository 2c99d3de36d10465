"""Rule ``cpp.format_string``: text of somebody else that is read as a format."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.code_pattern import places
from roslens.source.rules.cpp_statement import arguments_of, free_call
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_CALL = re.compile(
    rb"\b(printf|syslog|fprintf|ROS_(?:DEBUG|INFO|WARN|ERROR|FATAL)(?:_ONCE|_NAMED|_THROTTLE|_COND)?"
    rb"|RCLCPP_(?:DEBUG|INFO|WARN|ERROR|FATAL)(?:_ONCE)?|RCUTILS_LOG_\w+)\s*\("
)
_BEHIND = {"fprintf": 1, "syslog": 1}


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call whose last argument is the format, and is the text of a variable."""
    if b"c_str" not in view.code and b"what" not in view.code:
        return
    for match, node in places(_CALL, view, 1):
        call = free_call(node, view)
        arguments = arguments_of(call) if call is not None else []
        name = match[1].decode()
        before = _BEHIND.get(
            name, 1 if name.startswith("RCLCPP") or name.endswith(("_NAMED", "_THROTTLE", "_COND")) else 0
        )
        if len(arguments) != before + 1:
            continue
        text = view.text(arguments[before])
        if text.endswith((".c_str()", "->c_str()", ".what()", "->what()")):
            yield view.hit(
                "cpp.format_string",
                arguments[before],
                f'`{text[:60]}` is the format of `{name}`; expected `"%s", {text[:40]}`',
            )


RULE = FileRule(
    id="cpp.format_string",
    title="Format that is not a literal",
    finds="A text that is made at run time is handed over as the format: `printf(text)`, "
    '`ROS_INFO(text.c_str())`. Write `"%s", text`, or the stream form of the macro.',
    why="A `%` in a file name or an error message prints garbage or ends the node in the moment it reports a fault.",
    profiles=(
        "ros2",
        "ros1",
        "google",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/printf",
        "paper2016 format_string_var",
        "clang-tidy clang-diagnostic-format-security",
    ),
    bad="void f(const std::string& text) { ROS_INFO(text.c_str()); }\n",
    good='void f(const std::string& text) { ROS_INFO("%s", text.c_str()); }\n',
    syntax="cpp",
    whole=True,
    found=found,
)
