"""Rule ``node.callback_arguments_python``: a callback that cannot be called with what rclpy or rospy gives it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name, function_name
from roslens.source.rules.calls import arguments, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_callbacks import python_callbacks
from roslens.source.rules.flow.python_parameters import Takes, takes_of
from roslens.source.rules.flow.summary import CallbackKind, Registration
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_GIVEN: Mapping[CallbackKind, tuple[int, ...]] = {
    CallbackKind.SUBSCRIPTION: (1, 2),
    CallbackKind.TIMER: (0,),
    CallbackKind.SERVICE: (2,),
    CallbackKind.PARAMETERS: (1,),
    CallbackKind.EXECUTE: (1,),
    CallbackKind.GOAL: (1,),
    CallbackKind.CANCEL: (1,),
    CallbackKind.ACCEPTED: (1,),
    CallbackKind.FEEDBACK: (1,),
    CallbackKind.DONE: (1,),
}
"""How many arguments rclpy gives: rclpy/subscription.py tries one, then two; the others try once."""
_GIVEN_ROS1: Mapping[CallbackKind, tuple[int, ...]] = {
    CallbackKind.SUBSCRIPTION: (1,),
    CallbackKind.TIMER: (1,),
    CallbackKind.SERVICE: (1,),
    CallbackKind.EXECUTE: (1,),
}
_WHAT = {
    CallbackKind.SUBSCRIPTION: "the message",
    CallbackKind.SERVICE: "the request and the response",
    CallbackKind.PARAMETERS: "the list of parameters",
    CallbackKind.EXECUTE: "the goal handle",
    CallbackKind.GOAL: "the goal",
    CallbackKind.CANCEL: "the goal handle",
    CallbackKind.ACCEPTED: "the goal handle",
    CallbackKind.FEEDBACK: "the feedback",
    CallbackKind.DONE: "the future",
}
_WHAT_ROS1 = {
    **_WHAT,
    CallbackKind.TIMER: "a TimerEvent",
    CallbackKind.SERVICE: "the request",
    CallbackKind.EXECUTE: "the goal",
}


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each registration of a function that takes fewer or more arguments than it is given."""
    callbacks = python_callbacks(view)
    for one in callbacks.registrations if callbacks is not None else ():
        numbers = _numbers(one, view)
        takes = _takes(one, view)
        if takes is None or not numbers or any(takes.fits(number) for number in numbers):
            continue
        certainty = None if one.target.is_exact else Certainty.LIKELY
        message = _message(one, takes, numbers, view)
        yield view.hit("node.callback_arguments_python", one.argument, message, certainty=certainty)


def _numbers(one: Registration, view: FileView) -> tuple[int, ...]:
    """Return with how many arguments a callback may be called; none where nobody knows."""
    if not one.is_ros1:
        return _GIVEN.get(one.kind, ())
    if one.kind is CallbackKind.SUBSCRIPTION and ("callback_args" in keywords(one.call, view) or _has_more(one.call)):
        return (2,)
    if one.kind is CallbackKind.EXECUTE and callee_name(one.call, view) != "SimpleActionServer":
        return ()
    return _GIVEN_ROS1.get(one.kind, ())


def _has_more(call: Node) -> bool:
    """Tell whether ``callback_args`` of ``rospy.Subscriber`` may be given by position."""
    return len(arguments(call)) > 3 or any(one.type.endswith("_splat") for one in arguments(call))


def _takes(one: Registration, view: FileView) -> Takes | None:
    """Return what a callback takes; None where a decorator or rclpy decides that."""
    if one.kind is CallbackKind.TIMER and b"TimerInfo" in view.words:
        # Since Jazzy a timer gives its TimerInfo to a parameter that is annotated with it.
        return None
    if _is_decorated(one.target.function) and not one.target.is_exact:
        return None
    return takes_of(one.target, view)


def _is_decorated(function: Node) -> bool:
    return function.parent is not None and function.parent.type == "decorated_definition"


def _message(one: Registration, takes: Takes, numbers: tuple[int, ...], view: FileView) -> str:
    function = one.target.function
    if function.type == "lambda":
        name = f"`{view.short(function)}`"
    else:
        name = f"`{function_name(function, view)}` (line {function.start_point[0] + 1})"
    if takes.least == takes.most:
        taken = f"{takes.least} argument{'s' * (takes.least != 1)}"
    else:
        taken = f"{takes.least} to {takes.most} arguments" if takes.most is not None else f"at least {takes.least}"
    taken += f" and `{takes.named[0]}` by name" if takes.named else ""
    what = (_WHAT_ROS1 if one.is_ros1 else _WHAT).get(one.kind, "")
    number = numbers[0]
    given = f"{number}, {what}" if number and what else str(number) if number else "none"
    beside = " beside what is bound already" if one.target.bound else ""
    return (
        f"{name} takes {taken}{beside}, but is called with {given}: a TypeError; expected a signature that takes that"
    )


RULE = FileRule(
    id="node.callback_arguments_python",
    title="Callback that cannot be called (Python)",
    finds="A function that is handed over as a callback and takes fewer or more arguments than rclpy or rospy give it: "
    "a subscription gives the message, a timer nothing (in rospy an event), a service the request and the response (in "
    "rospy the request), a goal its handle, a parameter hook the list of parameters, a future itself. Methods, lambdas "
    "and `partial` are followed. Functions with decorators are left out.",
    why="Python raises a TypeError when the callback is registered, or at the first message, and the node ends.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("callbacks",),
    bad="""import rclpy
class Ears(Node):
    def __init__(self):
        self.create_subscription(String, "chirp", self.on_chirp, 10)
    def on_chirp(self):
        self.heard += 1
""",
    good="""import rclpy
class Ears(Node):
    def __init__(self):
        self.create_subscription(String, "chirp", self.on_chirp, 10)
    def on_chirp(self, message):
        self.heard += 1
""",
    syntax="python",
    whole=True,
    mentions=ROS_PYTHON,
    found=found,
)
