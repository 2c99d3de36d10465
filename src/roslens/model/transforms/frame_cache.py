"""What a buffer keeps of one frame: its transforms of the last seconds, or the one static one (`tf2::TimeCache`)."""

from __future__ import annotations

from bisect import bisect_left, bisect_right

from roslens.model.transforms.lookup import ExtrapolationError
from roslens.model.transforms.rotation import between
from roslens.model.transforms.transform import Transform

_SECOND = 1_000_000_000


class FrameCache:
    """The transforms of a frame by their stamps.

    What it keeps is decided by the first transform, as in tf2: where that is static, each further one takes its place.
    """

    def __init__(self, *, static: bool, keeps: int) -> None:
        """Keep transforms of ``keeps`` nanoseconds."""
        self.static = static
        self._keeps = keeps
        self._stamps: list[int] = []
        self._kept: list[Transform] = []

    def put(self, one: Transform) -> str:
        """Keep a transform; return why not, in words, and nothing where it is kept."""
        if self.static:
            self._kept = [one]
            return ""
        if self._stamps and self._stamps[-1] > one.stamp + self._keeps:
            return f'"{one.child}" has a stamp {_seconds(self._stamps[-1] - one.stamp)} before its newest one'
        place = bisect_right(self._stamps, one.stamp)
        if place and self._stamps[place - 1] == one.stamp:
            return f'"{one.child}" has a stamp that it had already'
        self._stamps.insert(place, one.stamp)
        self._kept.insert(place, one)
        oldest = bisect_left(self._stamps, self._stamps[-1] - self._keeps)
        del self._stamps[:oldest], self._kept[:oldest]
        return ""

    def newest(self) -> tuple[int, str]:
        """Return stamp and parent of the newest transform; 0 of a static one, no parent where there is none."""
        if not self._kept:
            return 0, ""
        return (0 if self.static else self._stamps[-1]), self._kept[-1].parent

    def at(self, time: int) -> Transform:
        """Return the transform at a time, interpolated; 0 is the newest.

        Raises:
            ExtrapolationError: the time is before or after what is kept.
        """
        if self.static or time == 0:
            return self._kept[-1]
        first, last = self._stamps[0], self._stamps[-1]
        if time == last:
            return self._kept[-1]
        if time == first:
            return self._kept[0]
        child = self._kept[-1].child
        if first == last or time > last:
            raise ExtrapolationError(child, time, last, single=first == last)
        if time < first:
            raise ExtrapolationError(child, time, first)
        place = bisect_left(self._stamps, time)
        if self._stamps[place] == time:
            return self._kept[place]
        older, newer = self._kept[place - 1], self._kept[place]
        return older if older.parent != newer.parent else _interpolated(older, newer, time)


def _interpolated(older: Transform, newer: Transform, time: int) -> Transform:
    ratio = (time - older.stamp) / (newer.stamp - older.stamp)
    x, y, z = (a + (b - a) * ratio for a, b in zip(older.translation, newer.translation, strict=True))
    return Transform(older.parent, older.child, time, (x, y, z), between(older.rotation, newer.rotation, ratio))


def _seconds(nanoseconds: int) -> str:
    return f"{nanoseconds / _SECOND:.3f} s"
