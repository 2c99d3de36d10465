"""The transforms of a recording: what was said on /tf and /tf_static, of which namespace they may be."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING

from roslens.compare.why.recorded import RecordedTransforms
from roslens.model.graph import Role
from roslens.model.transforms.probe import probed
from roslens.model.transforms.transform import Transform, frame_name
from roslens.model.transforms.tree import tree_of

if TYPE_CHECKING:
    from roslens.live.adapters.bag.bag import Bag

TYPES = frozenset({"tf2_msgs/TFMessage", "tf2_msgs/msg/TFMessage", "tf/tfMessage", "tf/msg/tfMessage"})
MOST_MESSAGES = 500_000
"""Messages that are read; those after them are left out, which is said."""
_STATIC = "tf_static"
_SECOND = 1_000_000_000


def recorded_transforms(bag: Bag, pair: tuple[str, ...]) -> RecordedTransforms:
    """Return the frames of a recording, and what look-ups between two of them came to."""
    topics = tuple(sorted({one.name for one in bag.topics if one.type in TYPES}))
    transforms = list(transforms_of(bag))
    publishers = {
        one.node for one in bag.graph().endpoints if one.name in topics and one.role is Role.PUBLISHER and one.node
    }
    tries = probed(transforms, pair[0], pair[1], round(bag.end * _SECOND)) if len(pair) > 1 else None
    return RecordedTransforms(tree_of(transforms), topics, tuple(sorted(publishers)), tries)


def too_many(bag: Bag) -> str:
    """Return in a sentence that not all transforms of a recording are read; empty where all are."""
    count = sum(one.count for one in bag.topics if one.type in TYPES)
    return f"{count:,} messages of transforms: the first {MOST_MESSAGES:,} were read" if count > MOST_MESSAGES else ""


def transforms_of(bag: Bag) -> Iterator[Transform]:
    """Yield what was said on topics of transforms, in order of receipt."""
    for one in islice(bag.decoded(TYPES), MOST_MESSAGES):
        static = one.topic.rpartition("/")[2] == _STATIC
        for said in one.message.transforms:
            stamp, place, turn = said.header.stamp, said.transform.translation, said.transform.rotation
            yield Transform(
                frame_name(str(said.header.frame_id)), frame_name(str(said.child_frame_id)),
                int(stamp.sec) * _SECOND + int(stamp.nanosec), (place.x, place.y, place.z),
                (turn.x, turn.y, turn.z, turn.w), static, one.time, one.publisher,
            )  # fmt: skip
