"""Rule ``node.goal_never_ended_python``: an action in rclpy whose goals never succeed, abort or are cancelled."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name, function_name
from roslens.source.rules.calls import receiver
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.flow.python_callbacks import python_callbacks
from roslens.source.rules.flow.python_functions import PythonFunctions
from roslens.source.rules.flow.python_parameters import parameters_of
from roslens.source.rules.flow.summary import CallbackKind, Target
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_ENDS = frozenset({"succeed", "abort", "canceled"})


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each function that carries out goals and never says how they ended."""
    callbacks = python_callbacks(view)
    said: set[int] = set()
    for one in callbacks.registrations if callbacks is not None else ():
        function = one.target.function
        if callbacks is None or one.is_ros1 or one.kind is not CallbackKind.EXECUTE or function.id in said:
            continue
        said.add(function.id)
        handle = _handle(one.target, view)
        if handle and not _may_end(function, handle, callbacks.functions, view):
            yield view.hit(
                "node.goal_never_ended_python",
                function.child_by_field_name("name") or function,
                f"`{function_name(function, view)}` carries out goals and never ends one: rclpy warns and reports "
                f"each as aborted; expected `{handle}.succeed()` before it returns",
            )


def _handle(target: Target, view: FileView) -> str:
    """Return the name of the parameter that is the goal handle; empty where that is not known."""
    if target.function.type != "function_definition" or not target.is_exact:
        return ""
    names = [one.name for one in parameters_of(target.function, view)]
    return names[target.bound] if len(names) > target.bound and names[target.bound] not in ("*", "**") else ""


def _may_end(function: Node, handle: str, functions: PythonFunctions, view: FileView) -> bool:
    """Tell whether a function, what it calls or what it gives the goal handle to may end the goal."""
    body = function.child_by_field_name("body")
    if body is None or not any(one.type == "return_statement" for one in below(body, "return_statement")):
        # What returns nothing is said by another rule.
        return True
    reached, waiting = {function.id}, [function]
    while waiting:
        one = waiting.pop()
        if any(callee_name(call, view) in _ENDS for call in below(one, "call")):
            return True
        for callee in functions.callees(one):
            if callee.id not in reached:
                reached.add(callee.id)
                waiting.append(callee)
    return _is_handed_on(body, handle, functions, view)


def _is_handed_on(body: Node, handle: str, functions: PythonFunctions, view: FileView) -> bool:
    """Tell whether a name is used for more than its attributes, outside of calls of functions of the file."""
    for one in below(body, "identifier"):
        if view.text(one) != handle or one.parent is None or one.parent.type == "attribute":
            continue
        call = one.parent.parent if one.parent.type == "argument_list" else None
        if call is None or call.type != "call" or not functions.called(call):
            return True
    methods = (call for call in below(body, "call") if view.text(receiver(call)) == handle)
    return any(callee_name(call, view) == "execute" for call in methods)


RULE = FileRule(
    id="node.goal_never_ended_python",
    title="Goal of an action that is never ended (rclpy)",
    finds="An `execute_callback` of an action server that, with all functions of the file that it calls, never calls "
    "`succeed`, `abort` or `canceled` of its goal handle. One that gives the handle to something else is left out.",
    why="rclpy takes a goal without a final state for aborted: clients see each goal fail, whatever the robot did.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("callbacks", "actions"),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.server = ActionServer(self, Move, "move", self.execute)
    def execute(self, goal_handle):
        self.move(goal_handle.request.position)
        return Move.Result()
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        self.server = ActionServer(self, Move, "move", self.execute)
    def execute(self, goal_handle):
        self.move(goal_handle.request.position)
        goal_handle.succeed()
        return Move.Result()
""",
    syntax="python",
    whole=True,
    words=("ActionServer",),
    mentions=RCLPY,
    found=found,
)
