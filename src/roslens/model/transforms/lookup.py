"""What a look-up in a buffer of transforms comes to, or why it fails: the errors of tf2."""

from __future__ import annotations

import msgspec

from roslens.model.transforms.transform import Quaternion, Vector

_SECOND = 1_000_000_000


class Found(msgspec.Struct, frozen=True):
    """The transform that takes coordinates of the source frame to the target frame; ``stamp`` in nanoseconds."""

    stamp: int
    translation: Vector
    rotation: Quaternion


class TransformError(Exception):
    """A look-up failed; ``kind`` is the name of the exception of tf2 without its end."""

    kind = "Transform"


class LookupFrameError(TransformError):
    """A frame is not known."""

    kind = "Lookup"


class InvalidFrameError(TransformError):
    """The name of a frame is none."""

    kind = "InvalidArgument"


class ConnectivityError(TransformError):
    """Two frames are in two trees."""

    kind = "Connectivity"


class LoopError(LookupFrameError):
    """A frame is above itself."""


class ExtrapolationError(TransformError):
    """A time is outside of what is kept of a frame.

    Attributes:
        frame: of which.
        time: that was asked for, in nanoseconds.
        known: nearest one that is kept.
    """

    kind = "Extrapolation"

    def __init__(self, frame: str, time: int, known: int, *, single: bool = False) -> None:
        """Keep the times; ``single`` where only one is kept."""
        self.frame, self.time, self.known = frame, time, known
        way = "into the future" if time > known else "into the past"
        off = abs(time - known) / _SECOND
        kept = "only" if single else "latest" if time > known else "earliest"
        super().__init__(f'"{frame}" would be extrapolated {way}: {off:.3f} s beyond its {kept} transform')
