"""A transform between two frames, as it is said on /tf or /tf_static."""

from __future__ import annotations

from math import isfinite

import msgspec

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
ZERO: Vector = (0.0, 0.0, 0.0)
IDENTITY: Quaternion = (0.0, 0.0, 0.0, 1.0)
_NORM_TOLERANCE = 10e-3
"""How far the squared length of a rotation may be from 1; as in tf2."""


class Transform(msgspec.Struct, frozen=True):
    """Where a frame is in its parent.

    Attributes:
        parent: ``header.frame_id``, without a leading slash.
        child: ``child_frame_id``, likewise.
        stamp: nanoseconds for which it holds; a static one holds for any time.
        translation: metres.
        rotation: quaternion x, y, z, w.
        static: whether it was said on /tf_static.
        received: nanoseconds of receipt.
        authority: node that said it; empty where unknown.
    """

    parent: str
    child: str
    stamp: int
    translation: Vector = ZERO
    rotation: Quaternion = IDENTITY
    static: bool = False
    received: int = 0
    authority: str = ""

    @property
    def flaw(self) -> str:
        """Why tf2 ignores it, in words; empty where it does not."""
        if self.parent == self.child:
            return f'"{self.child}" is its own parent'
        if not self.child or not self.parent:
            return f"its {'child' if not self.child else 'parent'} has no name"
        if not all(map(isfinite, (*self.translation, *self.rotation))):
            return f'"{self.child}" in "{self.parent}" has a value that is no number'
        if abs(sum(one * one for one in self.rotation) - 1) > _NORM_TOLERANCE:
            return f'"{self.child}" in "{self.parent}" has a rotation whose length is not 1'
        return ""


def frame_name(text: str) -> str:
    """Return the name of a frame as tf2 keeps it: without a leading slash."""
    return text.removeprefix("/")
