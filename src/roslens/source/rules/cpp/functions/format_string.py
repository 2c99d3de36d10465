"""Rule ``cpp.format_string``: text of somebody else that is read as a format."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp.functions.constant_text import constant_text
from roslens.source.rules.cpp_statement import arguments_of, callee
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_NAME = re.compile(
    r"(?:std::)?(?:f?printf|syslog)|ROS_(?:DEBUG|INFO|WARN|ERROR|FATAL)(?:_ONCE|_NAMED|_THROTTLE|_COND)?"
    r"|RCLCPP_(?:DEBUG|INFO|WARN|ERROR|FATAL)(?:_ONCE)?|RCUTILS_LOG_(?:DEBUG|INFO|WARN|ERROR|FATAL)"
)
_SECOND = re.compile(r"(?:std::)?fprintf|syslog|RCLCPP_\w+|\w+_(?:NAMED|THROTTLE|COND)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call whose last argument is the format, and is the text of a variable."""
    text = above(node, "call_expression")
    listed = text.parent if text is not None else None
    call = listed.parent if listed is not None and listed.type == "argument_list" else None
    if text is None or call is None or call.type != "call_expression":
        return
    name, arguments = callee(call, view), arguments_of(call)
    if not _NAME.fullmatch(name) or len(arguments) != 1 + bool(_SECOND.fullmatch(name)) or arguments[-1] != text:
        return
    written = view.text(text)
    if not written.endswith(("c_str()", "what()")):
        return
    message = f"`{view.short(text, 200)}` is the format of `{name}`"
    expected = 'expected `"%s"` before it'
    known = constant_text(_read_of(text), view)
    if known is None or "%" in known:
        yield view.hit("cpp.format_string", text, f"{message}; {expected}")
    else:
        always = f"{message}, always a text without `%`, so that nothing is printed wrong; {expected}"
        yield view.hit("cpp.format_string", text, always, certainty=Certainty.HEURISTIC)


def _read_of(call: Node) -> Node | None:
    """Return what the text of a call is read of."""
    function = call.child_by_field_name("function")
    return function.child_by_field_name("argument") if function is not None else None


RULE = FileRule(
    id="cpp.format_string",
    title="Format that is not a literal",
    finds="A text that is made at run time is handed over as the format: `printf(text)`, "
    '`ROS_INFO(text.c_str())`. Write `"%s", text`, or the stream form of the macro.',
    why="A `%` in a file name or an error message prints garbage or ends the node in the moment it reports a fault.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
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
    anchors=("c_str", "what"),
    found=found,
)
