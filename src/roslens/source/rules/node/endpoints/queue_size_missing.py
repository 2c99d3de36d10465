"""Rule ``node.queue_size_missing``: a publisher of rospy without a queue."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, keywords
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROSPY, FileRule

_MOST_POSITIONAL = 7
"""``queue_size`` is the eighth parameter."""

_HEAD = 40


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a publisher without ``queue_size``."""
    call = call_at(node)
    if call is None or view.text(call.child_by_field_name("function")) not in ("rospy.Publisher", "Publisher"):
        return
    # `except TypeError`: for versions of rospy that do not know the argument.
    handler = above(call, "except_clause", "function_definition")
    if handler is not None and b"TypeError" in view.code[handler.start_byte : handler.start_byte + _HEAD]:
        return
    given, named = arguments(call), keywords(call, view)
    if len(given) < 2 or len(given) > _MOST_POSITIONAL or any(one.type == "list_splat" for one in given):
        return
    if "queue_size" not in named and "**" not in named:
        yield view.hit(
            "node.queue_size_missing",
            call,
            f"`{view.short(call, 80)}` has no `queue_size`, so `publish` waits for the slowest subscriber; expected "
            "queue_size=1 or more",
        )


RULE = FileRule(
    id="node.queue_size_missing",
    title="Publisher without a queue (rospy)",
    finds="`rospy.Publisher` without `queue_size`. Name a size: 1 where only the newest counts.",
    why="Without a queue rospy publishes synchronously: one subscriber with a bad connection stops the node that "
    "publishes, "
    "and rospy warns at each start.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("endpoints", "queues"),
    bad='import rospy\npub = rospy.Publisher("state", State)\n',
    good='import rospy\npub = rospy.Publisher("state", State, queue_size=1)\n',
    syntax="python",
    anchors=("Publisher",),
    mentions=ROSPY,
    spares_tests=True,
    found=found,
)
