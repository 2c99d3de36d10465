"""Rule ``node.queue_of_images``: a subscription of rospy that works on ever older images."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.calls import arguments, call_at, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.messages.stamped import LARGE
from roslens.source.rules.rule import ROSPY, FileRule

_MOST_POSITIONAL = 4
_SELDOM = frozenset(("PoseArray", "Path", "MarkerArray", "OccupancyGrid"))
"""Large, but sent now and then."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a subscription of a large message without ``queue_size``."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or not 2 <= len(given) <= _MOST_POSITIONAL:
        return
    if view.text(call.child_by_field_name("function")) not in ("rospy.Subscriber", "Subscriber"):
        return
    named, kind = keywords(call, view), view.text(given[1]).rpartition(".")[2]
    if (
        kind in LARGE - _SELDOM
        and "queue_size" not in named
        and "**" not in named
        and b"message_filters" not in view.content
    ):
        yield view.hit(
            "node.queue_of_images",
            call,
            f"subscription of `{kind}` has no `queue_size`: messages pile up when the callback is slower; expected "
            "queue_size=1 with a `buff_size` that holds one",
        )


RULE = FileRule(
    id="node.queue_of_images",
    title="Images or clouds without a limit (rospy)",
    finds="`rospy.Subscriber` of an image, cloud, scan or map without `queue_size`. Name one, and a `buff_size` "
    "larger "
    "than a message.",
    why="rospy then hands over every message in its order: a detector that is slower than the camera works on what the "
    "camera saw seconds ago, later minutes.",
    profiles=("ros1",),
    tags=("endpoints", "queues", "performance"),
    bad="import rospy\nsub = rospy.Subscriber('image', Image, on_image)\n",
    good="import rospy\nsub = rospy.Subscriber('image', Image, on_image, queue_size=1, buff_size=2**24)\n",
    syntax="python",
    anchors=("Subscriber",),
    mentions=ROSPY,
    found=found,
)
