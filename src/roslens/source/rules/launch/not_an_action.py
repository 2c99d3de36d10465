"""Rule ``launch.not_an_action``: launch is given something else where it needs actions, a handler or a function."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import below
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_parameters import parameters_of
from roslens.source.rules.flow.summary import Target
from roslens.source.rules.launch.each_call import each_call
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import ACTION, CONDITION, ENTITY, HANDLER, SOURCE, SUBSTITUTION
from roslens.source.rules.views.launch_code import (
    DICTIONARY,
    LIST,
    MENTIONS,
    NOTHING,
    OBJECT,
    TEXT,
    TUPLE,
    LaunchCall,
    LaunchCode,
    in_words,
    shown,
)

_Found = Iterator[tuple[Node, str]]
_LISTS = {
    "LaunchDescription": "initial_entities", "GroupAction": "actions", "TimerAction": "actions", "RosTimer": "actions",
    "ROSTimer": "actions",
}  # fmt: skip
"""Parameters that hold a list of actions."""
_REFUSED = frozenset({SUBSTITUTION, CONDITION, SOURCE, TEXT, NOTHING, LIST, DICTIONARY, TUPLE})
_PARTS = frozenset({"ComposableNode", "ComposableLifecycleNode", "ParameterFile", "ParameterValue", "Parameter"})
"""Classes of parts of actions."""
_PROCESSES = frozenset({
    "ExecuteProcess", "ExecuteLocal", "Node", "LifecycleNode", "ComposableNodeContainer", "Shutdown",
})  # fmt: skip


def _judged(call: LaunchCall, code: LaunchCode) -> _Found:
    """Yield what is no action in a list of actions, no handler, and no function."""
    yield from _in_lists(call, code)
    yield from _single(call, code)
    yield from _targets(call, code)


def _in_lists(call: LaunchCall, code: LaunchCode) -> _Found:
    node = call.argument(_LISTS.get(call.name, ""))
    if node is None:
        return
    if code.sort(node) == ACTION:
        expected = f"`[{shown(node, code, 40).strip('`')}]`"
        yield node, f"{call.name} takes a list of actions, not an action: a TypeError; expected {expected}"
    for one in code.items(node):
        sort = code.sort(one)
        made = code.call(code.value(one))
        if sort == HANDLER:
            what = f"{shown(one, code)} is an event handler, not an action: the launch ends there"
            yield one, f"{what}; expected `RegisterEventHandler(…)` around it"
        elif sort in _REFUSED or (sort == OBJECT and made is not None and made.name in _PARTS):
            kind = in_words(sort) if made is None or sort != OBJECT else f"a {made.name}"
            yield one, f"{shown(one, code)} is {kind}, not an action: the launch ends there; expected an action"


def _single(call: LaunchCall, code: LaunchCode) -> _Found:
    function, handler = call.argument("function"), call.argument("event_handler")
    if call.name == "OpaqueFunction" and function is not None:
        sort = code.sort(function)
        if sort in (TEXT, LIST, NOTHING, ACTION, ENTITY):
            yield function, f"OpaqueFunction is given {in_words(sort)}: a TypeError; expected a function"
        elif what := _opaque(function, code):
            yield function, what
    if call.name == "RegisterEventHandler" and handler is not None:
        sort = code.sort(handler)
        if sort in (ACTION, SUBSTITUTION, CONDITION, LIST, TEXT):
            what = f"RegisterEventHandler is given {in_words(sort)}: the launch ends there"
            yield handler, f"{what}; expected an event handler such as `OnProcessExit(…)`"


def _opaque(given: Node, code: LaunchCode) -> str:
    """Return what is wrong with the function of an OpaqueFunction; empty where nothing is."""
    functions = python_functions(code.view)
    if given.type == "call":
        called = functions.called(given)
        makes_one = any(next(below(one.function, "function_definition", "lambda"), None) for one in called)
        if called and not makes_one and all(_is_function_of_file(one) for one in called):
            name = code.view.text(given.child_by_field_name("function"))
            return f"`{code.view.short(given)}` calls the function while the file is read; expected `{name}` itself"
        return ""
    targets = functions.meant(given)
    if len(targets) != 1 or not targets[0].is_exact or targets[0].bound or not _is_function_of_file(targets[0]):
        return ""
    if list(parameters_of(targets[0].function, code.view)):
        return ""
    name = code.view.text(given)
    return f"`{name}` takes no argument, and launch gives it the context: a TypeError; expected `def {name}(context)`"


def _is_function_of_file(target: Target) -> bool:
    return target.function.type == "function_definition"


def _targets(call: LaunchCall, code: LaunchCode) -> _Found:
    """Yield the target of a handler of processes where it is none."""
    target = call.argument("target_action")
    if call.name not in ("OnProcessExit", "OnProcessStart", "OnProcessIO") or target is None:
        return
    sort, made = code.sort(target), code.call(code.value(target))
    is_other = sort == ACTION and made is not None and made.name not in _PROCESSES
    if sort in (TEXT, LIST, TUPLE, SUBSTITUTION) or is_other:
        kind = f"a {made.name}" if made is not None else in_words(sort)
        what = f"the target of {call.name} is {kind}, which is no process: a TypeError"
        yield target, f"{what}; expected a `Node` or `ExecuteProcess`"


RULE = FileRule(
    id="launch.not_an_action",
    title="Something else where launch needs an action",
    finds="What is no action in the list of a `LaunchDescription`, `GroupAction` or `TimerAction`: an event handler "
    "without `RegisterEventHandler`, a `ComposableNode`, a text, None, a list. An action instead of a list, of an "
    "event handler or of a function; a function for `OpaqueFunction` that is called there, or takes no context; and a "
    "target of `OnProcessExit`, `OnProcessStart` or `OnProcessIO` that is no process.",
    why="launch raises an exception when it comes there: what follows does not start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch.actions import GroupAction\nfrom launch_ros.actions import Node\n\n"
    "drive = GroupAction(Node(package='base', executable='drive'))",
    good="from launch.actions import GroupAction\nfrom launch_ros.actions import Node\n\n"
    "drive = GroupAction([Node(package='base', executable='drive')])",
    found=each_call("launch.not_an_action", _judged),
)
