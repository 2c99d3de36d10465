"""Rule ``node.transform_wait_python``: a callback in rclpy that waits for a transform in the thread that gets them."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import arguments, call_at, keywords, number_of, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_callbacks import ways_to
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_threads import is_single_threaded, made_by
from roslens.source.rules.flow.spoken_way import spoken_way
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_PLACES = {"lookup_transform": 3, "can_transform": 3, "lookup_transform_full": 5, "can_transform_full": 5}
_BUFFERS = frozenset({"Buffer"})


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a look-up with a time limit in a callback, where one thread serves it and the listener."""
    call = call_at(node)
    of = receiver(call) if call is not None else None
    if call is None or of is None or not is_single_threaded(view):
        return
    given = arguments(call)
    place = _PLACES[view.text(node)]
    limit = keywords(call, view).get("timeout") or (given[place] if len(given) > place else None)
    if limit is None or not _waits(limit, view) or made_by(of, _BUFFERS, view) is None or not _is_listened(view):
        return
    known = [way for way in ways_to(call, view) if not way.registration.is_ros1]
    if known:
        yield view.hit(
            "node.transform_wait_python",
            call,
            f"`{view.short(call)}` in {spoken_way(known[0], view)} waits up to `{view.short(limit, 30)}` for a "
            "transform that the same thread would have to receive: it waits in vain; expected no time limit and "
            "another try at the next call, or `TransformListener(…, spin_thread=True)`",
        )


def _waits(limit: Node, view: FileView) -> bool:
    """Tell whether a time limit is a duration that is certainly more than nothing."""
    for one in python_functions(view).values(limit):
        if one.type == "call" and callee_name(one, view) == "Duration":
            lengths = [number_of(each, view) for each in (*keywords(one, view).values(), *arguments(one))]
            if any(each is not None and each > 0 for each in lengths):
                return True
    return False


def _is_listened(view: FileView) -> bool:
    """Tell whether all listeners of the file are served by the executor of their node."""
    made = [one for one in python_functions(view).calls if callee_name(one, view) == "TransformListener"]
    return bool(made) and not any("spin_thread" in keywords(one, view) or len(arguments(one)) > 2 for one in made)


RULE = FileRule(
    id="node.transform_wait_python",
    title="Wait for a transform in a callback (rclpy)",
    finds="`lookup_transform` or `can_transform` with a time limit in a callback, or in a function that one calls, of "
    "a node that one thread spins and whose listener has no thread of its own.",
    why="Transforms arrive by callbacks of the same thread, which waits here: what is not there yet does not come in "
    "this time, the look-up fails at its end, and everything else of the node has waited with it.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("callbacks", "transforms"),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_timer(0.1, self.tick)
    def tick(self):
        self.buffer.lookup_transform("map", "base", Time(), timeout=Duration(seconds=1.0))
rclpy.spin(Arm())
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self, spin_thread=True)
        self.create_timer(0.1, self.tick)
    def tick(self):
        self.buffer.lookup_transform("map", "base", Time(), timeout=Duration(seconds=1.0))
rclpy.spin(Arm())
""",
    syntax="python",
    anchors=tuple(_PLACES),
    mentions=RCLPY,
    found=found,
)
