"""Rule ``node.wait_in_callback_python``: a callback in Python that waits for somebody else."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import runs_once
from roslens.source.rules.calls import call_at
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.flow.python_waits import where_it_waits
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_AT_ONCE = re.compile(r"(?<![\d.])0+(\.0*)?(?![\d.])")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that waits in a callback; in rospy only those of topics and timers hold up others."""
    call = call_at(node)
    if call is None or _AT_ONCE.search(view.text(call.child_by_field_name("arguments"))):
        return
    around = above(call, "function_definition")
    if around is not None and runs_once(around, view):
        return
    where = where_it_waits(call, view)
    if where is not None:
        yield view.hit(
            "node.wait_in_callback_python",
            call,
            f"`{view.text(call)}` in {where.spoken}: nothing else is handled until it is there; expected a look at "
            "what is ready (`service_is_ready`, `server_is_ready`) or the wait outside of callbacks",
            callback=where.callback,
        )


RULE = FileRule(
    id="node.wait_in_callback_python",
    title="Waiting for a service, an action or a message in a callback (Python)",
    finds="`wait_for_service`, `wait_for_server`, `wait_for_result`, `wait_for_message` in a callback, or in "
    "a function that one calls. Look whether it is ready and come back instead.",
    why="Where the other node is late or gone, this one stops reacting; a message that is waited for in the thread "
    "that "
    "receives messages never comes.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "deadlock"),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.timer = self.create_timer(1.0, self.tick)
    def tick(self):
        self.client.wait_for_service()
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        self.timer = self.create_timer(1.0, self.tick)
    def tick(self):
        if self.client.service_is_ready():
            self.ask()
""",
    syntax="python",
    anchors=("wait_for_service", "wait_for_server", "wait_for_result", "wait_for_message"),
    mentions=ROS_PYTHON,
    found=found,
)
