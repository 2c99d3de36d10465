"""Rule ``launch.number_for_text``: launch is given a number, a bool or None where it needs a text."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.launch.each_call import each_call
from roslens.source.rules.rule import FileRule
from roslens.source.rules.views.launch_code import (
    ITEMS,
    LIST,
    MENTIONS,
    NOTHING,
    NUMBER,
    TRUTH,
    TUPLE,
    LaunchCall,
    LaunchCode,
    in_words,
    shown,
)

_Found = Iterator[tuple[Node, str]]
_SINGLE = frozenset({
    "package", "executable", "name", "namespace", "exec_name", "cwd", "msg", "value", "default_value", "plugin",
    "expected_value", "filename", "src", "dst", "path", "launch_file_path", "variable_name", "command", "text",
})  # fmt: skip
"""Parameters that take a text, a substitution or a list of both."""
_LISTS = frozenset({"arguments", "ros_arguments", "cmd", "substitutions", "choices"}) | _SINGLE
"""Parameters that take lists of these."""
_FREE = {
    "SetParameter": frozenset({"value"}), "SetUseSimTime": frozenset({"value"}), "ParameterValue": frozenset({"value"}),
    "Parameter": frozenset({"value"}), "DeclareBooleanLaunchArgument": frozenset({"default_value"}),
    "DeclareLaunchArgument": frozenset({"choices"}), "NotSubstitution": frozenset({"value"}),
}  # fmt: skip
"""What classes take other values for."""
_TABLES = frozenset({"env", "additional_env", "launch_arguments"})


def _judged(call: LaunchCall, code: LaunchCode) -> _Found:
    """Yield each number, bool or None for which launch raises a TypeError."""
    for name in call.signature.keywords:
        node = call.argument(name)
        if node is not None and name not in _FREE.get(call.name, ()):
            yield from _of_argument(call, name, node, code)


def _of_argument(call: LaunchCall, name: str, node: Node, code: LaunchCode) -> _Found:
    sort = code.sort(node)
    if name in _SINGLE and sort in (NUMBER, TRUTH):
        yield node, _message(f"`{name}` of {call.name}", node, sort, code)
    elif name in _LISTS and sort in (LIST, TUPLE):
        yield from _of_items(f"`{name}` of {call.name}", node, code)
    elif name in _TABLES:
        yield from _of_values(name, node, code)


def _of_items(where: str, node: Node, code: LaunchCode) -> _Found:
    for one in code.items(node):
        if (sort := code.sort(one)) in (NUMBER, TRUTH, NOTHING):
            yield one, _message(where, one, sort, code)
            return


def _of_values(name: str, node: Node, code: LaunchCode) -> _Found:
    value = code.value(node)
    if value is not None and code.sort(value) == ITEMS:
        function = value.child_by_field_name("function")
        value = function.child_by_field_name("object") if function is not None else None
    pairs = [*code.pairs(value)]
    if name == "launch_arguments":
        pairs += [(both[0], both[1]) for one in code.items(value) if len(both := code.items(one)) == 2]
    for key, given in pairs:
        if (sort := code.sort(given)) in (NUMBER, TRUTH, NOTHING):
            yield given, _message(f"{shown(key, code)} of `{name}`", given, sort, code)


def _message(where: str, node: Node, sort: str, code: LaunchCode) -> str:
    value = code.value(node)
    text = code.view.text(value) if value is not None else ""
    text = text.lower() if sort == TRUTH else text
    expected = f"`'{text}'`" if sort in (NUMBER, TRUTH) and len(text) < 20 and " " not in text else "a text"
    return f"{where} is {shown(node, code)}, {in_words(sort)}: launch raises a TypeError; expected {expected}"


RULE = FileRule(
    id="launch.number_for_text",
    title="Number or bool where launch needs a text",
    finds="A number, a bool or None for a parameter of a class of launch that takes texts and substitutions: the "
    "default of an argument, an item of `arguments` or `cmd`, a value of `launch_arguments` or of the environment, a "
    "name.",
    why="launch raises a TypeError, which says that an object is not iterable: nothing starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch.actions import DeclareLaunchArgument\n\n"
    "use_rviz = DeclareLaunchArgument('use_rviz', default_value=True)",
    good="from launch.actions import DeclareLaunchArgument\n\n"
    "use_rviz = DeclareLaunchArgument('use_rviz', default_value='true')",
    found=each_call("launch.number_for_text", _judged),
)
