"""Rule ``node.callback_returns_nothing_python``: a callback whose result rclpy or rospy needs returns none."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name, function_name
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.flow.python_callbacks import python_callbacks
from roslens.source.rules.flow.python_returns import Returns, returns_of
from roslens.source.rules.flow.summary import CallbackKind, Registration
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_NEEDS: Mapping[CallbackKind, tuple[str, str]] = {
    CallbackKind.SERVICE: ("rclpy raises a TypeError instead of answering", "`return response`"),
    CallbackKind.PARAMETERS: (
        "an AttributeError when a parameter is set",
        "`return SetParametersResult(successful=True)`",
    ),
    CallbackKind.EXECUTE: ("the client never gets a result", "`return` with a `Result()` of the action"),
    CallbackKind.GOAL: ("rclpy rejects the goal", "`return GoalResponse.ACCEPT` or `REJECT`"),
    CallbackKind.CANCEL: ("rclpy refuses to cancel", "`return CancelResponse.ACCEPT` or `REJECT`"),
}
"""What follows, and what is expected."""
_LITERALS = frozenset(("true", "false", "integer", "float", "string"))
_ROS1 = ("the call fails: `service handler returned None`", "`return` with the response")


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each function that is handed over where its result is needed, and that returns none on some way."""
    callbacks = python_callbacks(view)
    said: set[int] = set()
    for one in callbacks.registrations if callbacks is not None else ():
        function = one.target.function
        if function.id in said or not _is_asked(one, view) or not _is_plain(function):
            continue
        returns = returns_of(function, view)
        hit = _literal(one, returns, view) or _hit(one, returns, view)
        if hit is not None:
            said.add(function.id)
            yield hit


def _is_asked(one: Registration, view: FileView) -> bool:
    if one.is_ros1:
        return one.kind is CallbackKind.SERVICE
    return one.kind in _NEEDS and callee_name(one.call, view) != "set_parameters_callback"


def _is_plain(function: Node) -> bool:
    decorated = function.parent is not None and function.parent.type == "decorated_definition"
    return function.type == "function_definition" and not decorated


def _hit(one: Registration, returns: Returns, view: FileView) -> Hit | None:
    function = one.target.function
    follows, expected = _ROS1 if one.is_ros1 else _NEEDS[one.kind]
    name = f"callback `{function_name(function, view)}`"
    if returns.is_generator or not (returns.falls_off or returns.empty):
        return None
    if not returns.values:
        at = function.child_by_field_name("name") or function
        if not returns.falls_off and not returns.empty:
            return None
        message = f"{name} of a {_spoken(one)} returns nothing: {follows}; expected {expected}"
        certainty = None if one.target.is_exact else Certainty.LIKELY
        return view.hit("node.callback_returns_nothing_python", at, message, certainty=certainty)
    if one.is_ros1:
        # rospy documents None as the way to say that a request cannot be processed.
        return None
    where = f"in line {returns.empty[0].start_point[0] + 1}" if returns.empty else "where its end is reached"
    at = returns.empty[0] if returns.empty else function.child_by_field_name("name") or function
    message = f"{name} of a {_spoken(one)} returns nothing {where}: {follows}; expected {expected} there too"
    return view.hit("node.callback_returns_nothing_python", at, message, certainty=Certainty.LIKELY)


def _literal(one: Registration, returns: Returns, view: FileView) -> Hit | None:
    """Return that a service of rclpy answers with a literal."""
    function = one.target.function
    if one.kind is not CallbackKind.SERVICE or one.is_ros1 or returns.is_generator:
        return None
    value = _literal_of(function, returns, view)
    if value is None:
        return None
    (at, text), (follows, expected) = value, _NEEDS[one.kind]
    what = f"callback `{function_name(function, view)}` of a {_spoken(one)} returns {text}, which is no response"
    message = f"{what}: {follows}; expected {expected}"
    return view.hit("node.callback_returns_nothing_python", at, message, certainty=Certainty.LIKELY)


def _literal_of(function: Node, returns: Returns, view: FileView) -> tuple[Node, str] | None:
    """Return where a function returns a literal, or a name that it gives one, and how that is written."""
    for statement in returns.values:
        value = statement.named_children[0]
        if value.type in _LITERALS:
            return statement, f"`{view.short(value)}`"
        if value.type != "identifier":
            continue
        for assigned in below(function, "assignment", inside=("function_definition", "lambda", "class_definition")):
            right, left = assigned.child_by_field_name("right"), assigned.child_by_field_name("left")
            if right is not None and right.type in _LITERALS and view.text(left) == view.text(value):
                return assigned, f"`{view.short(value)}` when that is `{view.short(right)}`"
    return None


def _spoken(one: Registration) -> str:
    if one.kind is CallbackKind.SERVICE:
        return "service"
    return "parameter hook" if one.kind is CallbackKind.PARAMETERS else "action"


RULE = FileRule(
    id="node.callback_returns_nothing_python",
    title="Callback that returns nothing where a result is needed (Python)",
    finds="A callback of a service, of parameters or of an action (execute, goal, cancel) that returns nothing, or "
    "nothing on some way to its end; in rclpy also a service that returns a literal such as `False`. In rospy a "
    "service may return None to say that it failed, so that only one that never returns anything is reported.",
    why="rclpy takes what the callback returns for the answer: with None a service or a change of a parameter ends "
    "the node with an exception, a goal is rejected or its result never comes.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "services"),
    bad="""import rclpy
class Gate(Node):
    def __init__(self):
        self.create_service(Trigger, "open", self.on_open)
    def on_open(self, request, response):
        response.success = True
""",
    good="""import rclpy
class Gate(Node):
    def __init__(self):
        self.create_service(Trigger, "open", self.on_open)
    def on_open(self, request, response):
        response.success = True
        return response
""",
    syntax="python",
    whole=True,
    mentions=ROS_PYTHON,
    found=found,
)
