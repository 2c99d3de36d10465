"""Rule ``launch.argument_shape``: an argument of a class of launch has a shape that launch refuses."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.launch.each_call import each_call
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import SUBSTITUTION
from roslens.source.rules.views.launch_code import (
    DICTIONARY,
    ITEMS,
    LIST,
    MENTIONS,
    NOTHING,
    NUMBER,
    OBJECT,
    SET,
    TEXT,
    TRUTH,
    TUPLE,
    LaunchCall,
    LaunchCode,
    in_words,
    shown,
)
from roslens.source.rules.views.python_names import text_of

_Found = Iterator[tuple[Node, str]]
_PAIRS = "pairs: `[('from', 'to')]`"


def _judged(call: LaunchCall, code: LaunchCode) -> _Found:
    """Yield each argument whose shape launch refuses, or takes for something else."""
    for name in sorted(_JUDGES.keys() & call.signature.keywords.keys()):
        node = call.argument(name)
        if node is not None:
            yield from _JUDGES[name](call, node, code)


def _parameters(call: LaunchCall, node: Node, code: LaunchCode) -> _Found:
    sort = code.sort(node)
    refused = {TEXT, DICTIONARY, SUBSTITUTION, NUMBER, OBJECT} | ({TUPLE} if call.signature.kind else set())
    if sort in refused:
        given = f"`{_keyword(node)}` is {in_words(sort)}: {call.name} raises a TypeError"
        yield node, f"{given}; expected a list: `[{shown(node, code, 40).strip('`')}]`"
        return
    for one in code.items(node):
        if what := _parameter(one, code):
            yield one, what
        elif code.sort(one) == DICTIONARY:
            yield from _parameter_values(one, code)


def _keyword(node: Node) -> str:
    """Return the keyword that a value is given by; of a value by position, what all such values are."""
    around = node.parent
    named = around.child_by_field_name("name") if around is not None and around.type == "keyword_argument" else None
    return "parameters" if named is None else text_of(named)


def _parameter(node: Node, code: LaunchCode) -> str:
    """Return what is wrong about an item of ``parameters``."""
    sort, text = code.sort(node), code.text(node)
    if sort == SET and len(code.items(node)) > 1:
        return f"{shown(node, code)} is a set, not a dictionary; expected `{{'name': value}}`"
    if sort in (NUMBER, TRUTH, NOTHING):
        given = f"{shown(node, code)} in `parameters` is {in_words(sort)}: a TypeError"
        return f"{given}; expected a dictionary or the path of a file"
    if text is not None and ": " in text and "\n" not in text and "/" not in text:
        return f"{shown(node, code)} is taken for the path of a file; expected a dictionary `{{name: value}}`"
    if sort in (LIST, TUPLE) and any(code.sort(one) == DICTIONARY for one in code.items(node)):
        return "a dictionary in a list in `parameters` is a TypeError; expected the dictionary itself"
    return ""


def _parameter_values(node: Node, code: LaunchCode) -> _Found:
    for key, value in code.pairs(node):
        if code.sort(value) in (NOTHING, "condition", "action"):
            yield value, f"parameter {shown(key, code)} is {shown(value, code)}: a TypeError; expected a value"


def _remappings(call: LaunchCall, node: Node, code: LaunchCode) -> _Found:
    sort = code.sort(node)
    # A set of pairs is one that launch_ros goes through like any other.
    if sort in (TEXT, DICTIONARY, SUBSTITUTION):
        yield node, f"`remappings` is {in_words(sort)}: {call.name} raises a TypeError; expected a list of {_PAIRS}"
        return
    for one in code.items(node):
        sort = code.sort(one)
        if sort in (TEXT, LIST, DICTIONARY, SET, SUBSTITUTION):
            what = f"{shown(one, code)} in `remappings` is {in_words(sort)}, not a tuple: a TypeError"
            yield one, f"{what}; expected {_PAIRS}"
            return
        if sort == TUPLE and (count := _length(one, code)) != 2:
            yield one, f"{shown(one, code)} has {count} items: a TypeError; expected {_PAIRS}"


def _length(node: Node, code: LaunchCode) -> int:
    """Return how many items a tuple has; 2 where that is not known."""
    value = code.value(node)
    if value is None or value.type != "tuple" or any(one.type == "list_splat" for one in value.named_children):
        return 2
    return len(code.items(value))


def _arguments(_call: LaunchCall, node: Node, code: LaunchCode) -> _Found:
    yield from _words("arguments", "each of its characters is an argument", node, code)


def _command(call: LaunchCall, node: Node, code: LaunchCode) -> _Found:
    if call.name == "ExecuteProcess":
        yield from _words("cmd", "each of its characters is a word of the command", node, code)


def _words(name: str, result: str, node: Node, code: LaunchCode) -> _Found:
    sort, text = code.sort(node), code.text(node)
    if sort == TEXT and text != "":
        expected = f"`{text.split()!r}`" if text and len(text) < 60 else "a list of words"
        yield node, f"`{name}` is one text: {result}; expected {expected}"
    elif sort == SUBSTITUTION:
        yield node, f"`{name}` is a substitution: a TypeError; expected a list: `[{shown(node, code, 40).strip('`')}]`"


def _ros_arguments(_call: LaunchCall, node: Node, code: LaunchCode) -> _Found:
    if (sort := code.sort(node)) in (TEXT, TUPLE, SUBSTITUTION):
        yield node, f"`ros_arguments` is {in_words(sort)}: a TypeError; expected a list"


def _environment(call: LaunchCall, node: Node, code: LaunchCode) -> _Found:
    if (sort := code.sort(node)) in (TEXT, LIST, TUPLE, SET, SUBSTITUTION):
        given = f"the environment is {in_words(sort)}: {call.name} raises an AttributeError"
        yield node, f"{given}; expected `{{'NAME': 'value'}}`"


def _launch_arguments(_call: LaunchCall, node: Node, code: LaunchCode) -> _Found:
    value = code.value(node)
    if value is not None and value.type == "attribute" and code.view.text(value).endswith(".items"):
        yield node, "`launch_arguments` is the method `items`, which is not called: a TypeError; expected `.items()`"
    elif code.sort(node) == DICTIONARY:
        expected = f"`{shown(node, code, 30).strip('`')}.items()`"
        yield node, f"`launch_arguments` is a dictionary: the launch ends with a ValueError; expected {expected}"
    elif code.sort(node) != ITEMS:
        for one in code.items(value):
            if code.sort(one) in (DICTIONARY, TEXT, SUBSTITUTION):
                what = f"{shown(one, code)} in `launch_arguments` is no pair: a ValueError"
                yield one, f"{what}; expected `('name', value)`"


_JUDGES: dict[str, Callable[[LaunchCall, Node, LaunchCode], _Found]] = {
    "parameters": _parameters,
    "extra_arguments": _parameters,
    "remappings": _remappings,
    "arguments": _arguments,
    "ros_arguments": _ros_arguments,
    "cmd": _command,
    "env": _environment,
    "additional_env": _environment,
    "launch_arguments": _launch_arguments,
}

RULE = FileRule(
    id="launch.argument_shape",
    title="Argument of a shape that launch refuses",
    finds="Arguments of classes of launch that have another shape than launch needs: `parameters` that is no list, or "
    "holds a set or a text `name: value`; `remappings` that holds no pairs; `arguments` or `cmd` as one text, which is "
    "taken apart into characters; an environment that is no dictionary; `launch_arguments` as a dictionary without "
    "`.items()`.",
    why="launch raises an exception, or passes each character as an argument: the node does not start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch_ros.actions import Node\n\n"
    "node = Node(package='base', executable='drive', remappings=['odom', 'wheels'])",
    good="from launch_ros.actions import Node\n\n"
    "node = Node(package='base', executable='drive', remappings=[('odom', 'wheels')])",
    found=each_call("launch.argument_shape", _judged),
)
