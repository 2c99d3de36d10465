"""Rule ``node.flag_in_callback_python``: a callback in rclpy that loops until another callback sets a value."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import function_around
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.flow.python_callbacks import ways_to
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_waited import brought_by_callbacks
from roslens.source.rules.flow.spoken_way import spoken_way
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_QUIET = frozenset(
    ("sleep", "get_logger", "info", "warn", "warning", "debug", "error", "print", "now", "get_clock", "ok", "time")
)
"""What a loop that does nothing but wait calls."""
_LEAVES = ("break_statement", "return_statement", "raise_statement", "await", "yield", "assignment")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop that does nothing until an attribute changes, which only callbacks change that cannot run."""
    flag = _flag(node, view)
    known = ways_to(node, view) if flag is not None else ()
    setters = _setters(flag, view) if flag is not None and known else ()
    for way in known if setters else ():
        why = None if way.registration.is_ros1 else brought_by_callbacks(way, setters, view)
        if why is not None and flag is not None:
            line = setters[0].start_point[0] + 1
            yield view.hit(
                "node.flag_in_callback_python",
                node.child_by_field_name("condition") or node,
                f"`{view.text(flag)}` is waited for in {spoken_way(way, view)}: the callback that sets it (line "
                f"{line}) never runs meanwhile, for {why.because}; expected to go on in that callback",
            )
            return


def _flag(loop: Node, view: FileView) -> Node | None:
    """Return the one attribute of ``self`` for whose change a loop waits, doing nothing else."""
    condition, body = loop.child_by_field_name("condition"), loop.child_by_field_name("body")
    if condition is None or body is None or next(below(body, *_LEAVES), None) is not None:
        return None
    if any(callee_name(call, view) not in _QUIET for call in below(loop, "call")):
        return None
    read = [one for one in (condition, *below(condition, "attribute")) if one.type == "attribute"]
    flags = [one for one in read if view.text(one).startswith("self.") and not _is_called(one)]
    plain = [one for one in flags if view.text(one).count(".") == 1]
    return plain[0] if len({view.text(one) for one in plain}) == 1 else None


def _is_called(attribute: Node) -> bool:
    around = attribute.parent
    while around is not None and around.type == "attribute":
        around = around.parent
    return around is not None and around.type == "call"


def _setters(flag: Node, view: FileView) -> Sequence[Node]:
    """Return what is assigned to an attribute outside of ``__init__`` and of the function that waits."""
    functions = python_functions(view)
    of = functions.class_around(flag)
    name = view.text(flag.child_by_field_name("attribute"))
    own = function_around(flag)
    found_setters = []
    for value in functions.attribute(of, name) if of is not None else ():
        around = function_around(value)
        is_start = around is None or view.text(around.child_by_field_name("name")) == "__init__"
        if not is_start and around != own:
            found_setters.append(value)
    return found_setters


RULE = FileRule(
    id="node.flag_in_callback_python",
    title="Waiting for another callback in a callback (rclpy)",
    finds="A loop in a callback, or in a function that one calls, that does nothing but sleep until an attribute "
    "changes, where only callbacks of the same mutually exclusive callback group change it, or one thread runs all "
    "callbacks. Go on in the callback that changes it, or give the two groups of their own and use a "
    "MultiThreadedExecutor.",
    why="The other callback waits for this one to end: the loop never ends, and the node does nothing any more.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("callbacks", "deadlock"),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.pose = None
        self.create_subscription(Pose, "pose", self.on_pose, 10)
        self.create_timer(1.0, self.tick)
    def on_pose(self, pose):
        self.pose = pose
    def tick(self):
        while self.pose is None:
            time.sleep(0.1)
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        self.pose = None
        self.create_subscription(Pose, "pose", self.on_pose, 10)
        self.create_timer(1.0, self.tick)
    def on_pose(self, pose):
        self.pose = pose
    def tick(self):
        if self.pose is None:
            return
""",
    syntax="python",
    kinds=("while_statement",),
    mentions=RCLPY,
    found=found,
)
