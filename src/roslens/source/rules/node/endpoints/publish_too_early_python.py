"""Rule ``node.publish_too_early_python``: a message that is published before anybody can be connected, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callbacks_of, function_name
from roslens.source.rules.calls import (
    body_of,
    call_at,
    called_names,
    function_around,
    is_conditional,
    loop_around,
    statement_around,
)
from roslens.source.rules.file_view import FileView, above, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_TIME_PASSES = re.compile(
    rb"sleep|spin|wait|input|get_num_connections|get_subscription_count|TRANSIENT|transient|[lL]atch|lookup|for |"
    rb"while |qos",
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first ``publish`` in the function that made the publisher, where nothing waits between."""
    call = call_at(node)
    if call is None or call.parent is None or call.parent.type != "assignment":
        return
    function = function_around(call)
    body = body_of(function) if function is not None else view.root
    name = view.text(call.parent.child_by_field_name("left"))
    if body is None or not name or "[" in name or (function is not None and is_conditional(call, function)):
        return
    start = statement_around(call).end_byte
    passes = _TIME_PASSES.search(view.code, call.start_byte, body.end_byte)
    published = re.compile(rb"(?<![\w.])" + re.escape(name.encode()) + rb"\.(publish)\b")
    match = published.search(view.code, start, body.end_byte if passes is None else passes.end() - 1)
    if match is None:
        return
    place = view.node_at(match.start(1), match.end(1))
    if place is None or function_around(place) != function or loop_around(place) != loop_around(call):
        return
    if not _publishes_elsewhere(name, call, view) and not _is_made_again(node, function, view):
        yield view.hit(
            "node.publish_too_early_python",
            place.parent or place,
            f"`{name}` publishes right after it was made, before any subscription is matched: the message is lost; "
            "expected it later, or transient local (latched)",
        )


def _publishes_elsewhere(name: str, call: Node, view: FileView) -> bool:
    """Return whether the publisher publishes in another function or lambda, too: its first message is not the last."""
    function = function_around(call)
    of = above(call, "class_definition") if name.startswith("self.") else function
    around = of if of is not None else view.root
    published = re.compile(rb"(?<![\w.])" + re.escape(name.encode()) + rb"\.(publish)\b")
    places = published.finditer(view.code, around.start_byte, around.end_byte)
    nodes = (view.node_at(match.start(1), match.end(1)) for match in places)
    return any(function_around(one) != function for one in nodes if one is not None)


def _is_made_again(made: Node, function: Node | None, view: FileView) -> bool:
    """Return whether a publisher of rospy is made in what callbacks run: all of a topic are one, which stays."""
    if function is None or function.type != "function_definition" or view.text(made) != "Publisher":
        return False
    names = {one.rpartition(".")[2] for one in callbacks_of(view)}
    name = function_name(function, view).rpartition(".")[2]
    if name in names:
        return True
    return any(
        name in called_names(one, view)
        for one in below(view.root, "function_definition")
        if view.text(one.child_by_field_name("name")) in names
    )


RULE = FileRule(
    id="node.publish_too_early_python",
    title="Message published right after its publisher was made (Python)",
    finds="A publisher and its first `publish` in one function, with no wait between. A publisher that "
    "publishes in another function, too, is let be, and so is one of rospy that callbacks make. Publish later, wait "
    "for subscriptions, or make it transient local (rclpy) or latched (rospy).",
    why="Subscriptions are matched over the network after the call that makes the publisher: what is published at once "
    "reaches nobody, on most days. Publishers of rospy on one topic share their connections, which stay: there only "
    "the very first message of a process is lost, which is all there is where a program publishes once.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("endpoints",),
    bad="""import rospy
pub = rospy.Publisher("state", State, queue_size=1)
pub.publish(State())
""",
    good="""import rospy
pub = rospy.Publisher("state", State, queue_size=1, latch=True)
pub.publish(State())
""",
    syntax="python",
    anchors=("Publisher", "create_publisher"),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
