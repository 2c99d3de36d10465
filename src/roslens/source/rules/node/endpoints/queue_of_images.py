"""Rule ``node.queue_of_images``: a subscription of rospy that works on ever older images."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, called_names, keywords
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.messages.stamped import LARGE, SELDOM
from roslens.source.rules.rule import ROSPY, FileRule

_MOST_POSITIONAL = 4
_SMALL = frozenset(("LaserScan", "MultiEchoLaserScan"))
"""Of a few kilobytes."""
_LIGHT = frozenset((
    *("imgmsg_to_cv2", "compressed_imgmsg_to_cv2", "CvBridge", "fromstring", "frombuffer", "imdecode", "resize"),
    *("copy", "loginfo", "logdebug", "logwarn", "logerr", "print", "info", "debug", "warn", "now", "len", "str"),
))  # fmt: skip
"""What a callback calls that only keeps its message."""


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
        kind in LARGE - SELDOM - _SMALL
        and "queue_size" not in named
        and "**" not in named
        and not view.mentions((b"message_filters",))
        and not _only_keeps(given, view)
    ):
        yield view.hit(
            "node.queue_of_images",
            call,
            f"subscription of `{kind}` has no `queue_size`: messages pile up when the callback is slower; expected "
            "queue_size=1 with a `buff_size` that holds one",
        )


def _only_keeps(given: Sequence[Node], view: FileView) -> bool:
    """Return whether the callback is a function of this file that keeps the message, and is done before the next."""
    name = view.text(given[2]).rpartition(".")[2] if len(given) > 2 else ""
    places = [match.start(1) for match in re.finditer(rb"\bdef[ \t]+(" + re.escape(name.encode()) + rb")\b", view.code)]
    if not name.isidentifier() or len(places) != 1:
        return False
    node = view.node_at(places[0], places[0] + len(name))
    function = node.parent if node is not None else None
    if function is None or next(below(function, "for_statement", "while_statement"), None) is not None:
        return False
    return called_names(function, view) <= _LIGHT


RULE = FileRule(
    id="node.queue_of_images",
    title="Images or clouds without a limit (rospy)",
    finds="`rospy.Subscriber` of an image or cloud without `queue_size`, whose callback does more than keep it. "
    "Name one, and a `buff_size` "
    "larger "
    "than a message.",
    why="rospy then hands over every message in its order: a detector that is slower than the camera works on what the "
    "camera saw seconds ago, later minutes. How long a callback takes the code seldom says: it is a note.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros1",),
    tags=("endpoints", "queues", "performance"),
    bad="import rospy\nsub = rospy.Subscriber('image', Image, on_image)\n",
    good="import rospy\nsub = rospy.Subscriber('image', Image, on_image, queue_size=1, buff_size=2**24)\n",
    syntax="python",
    anchors=("Subscriber",),
    mentions=ROSPY,
    found=found,
)
