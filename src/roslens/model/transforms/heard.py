"""What was said on topics of transforms while somebody listened."""

from __future__ import annotations

import msgspec

from roslens.model.transforms.transform import Transform


class HeardTransforms(msgspec.Struct, frozen=True):
    """Transforms in order of receipt.

    Attributes:
        start: since when it was listened, in seconds since the epoch.
        end: until when.
        topics: those of transforms that were there.
        transforms: what came.
    """

    start: float
    end: float
    topics: tuple[str, ...] = ()
    transforms: tuple[Transform, ...] = ()
