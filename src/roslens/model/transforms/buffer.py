"""A buffer of transforms that answers as tf2's does (`tf2::BufferCore` of ROS Noetic; ROS 2 computes the same).

The algorithms are those of `BufferCore::walkToTopParent` and `getLatestCommonTime`, their odd cases included: a
program on the robot asks that one.
"""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.transforms.frame_cache import FrameCache
from roslens.model.transforms.lookup import (
    ConnectivityError,
    ExtrapolationError,
    Found,
    InvalidFrameError,
    LookupFrameError,
    LoopError,
)
from roslens.model.transforms.rotation import added, inverse, product, rotated
from roslens.model.transforms.transform import IDENTITY, ZERO, Quaternion, Transform, Vector

KEEPS_NS = 10_000_000_000
"""How much a buffer keeps by default, in nanoseconds."""
_DEEPEST = 1000
_Pose = tuple[Vector, Quaternion]


class TransformBuffer:
    """Keeps transforms of the last ten seconds, and looks up what lies between two frames."""

    def __init__(self, keeps: int = KEEPS_NS) -> None:
        """Keep transforms of ``keeps`` nanoseconds before the newest one of each frame."""
        self._keeps = keeps
        self._caches: dict[str, FrameCache] = {}
        self._names: set[str] = set()

    @property
    def frames(self) -> frozenset[str]:
        """All frames that were named, as child or as parent."""
        return frozenset(self._names)

    def put(self, one: Transform) -> str:
        """Keep a transform; return why not, in words, and nothing where it is kept."""
        if flaw := one.flaw:
            return flaw
        cache = self._caches.get(one.child)
        if cache is None:
            cache = self._caches[one.child] = FrameCache(static=one.static, keeps=self._keeps)
        flaw = cache.put(one)
        # A parent is known only by a transform that was kept.
        self._names |= {one.child} if flaw else {one.child, one.parent}
        return flaw

    def parent(self, frame: str) -> str:
        """Return the parent of a frame by its newest transform; empty where it has none."""
        cache = self._caches.get(frame)
        return cache.newest()[1] if cache is not None else ""

    def look_up(self, target: str, source: str, time: int = 0) -> Found:
        """Return what takes coordinates of ``source`` to ``target`` at a time; 0 is the newest that both have.

        Raises:
            InvalidFrameError: a name is empty or begins with a slash.
            LookupFrameError: a frame is not known, or there is a loop.
            ConnectivityError: the two are in two trees.
            ExtrapolationError: what lies between them has no transform at that time.
        """
        if target == source:
            # As in tf2, whatever the name is.
            cache = self._caches.get(target)
            return Found(time or (cache.newest()[0] if cache is not None else 0), ZERO, IDENTITY)
        self._check(target)
        self._check(source)
        if time == 0:
            time = self.latest_common_time(target, source)
        up, top, gap = self._climb(source, target, time)
        if top is None:
            return _found(time, up, [])
        down = self._descend(target, source, top, time, gap)
        if down is None:
            raise ConnectivityError(f'"{target}" and "{source}" are in two trees')
        return _found(time, *down) if down[0] is None else _found(time, up, down[1])

    def _check(self, frame: str) -> None:
        if not frame:
            raise InvalidFrameError("a frame without a name")
        if frame.startswith("/"):
            raise InvalidFrameError(f'"{frame}" begins with a slash, which names of frames must not')
        if frame not in self._names:
            raise LookupFrameError(f'"{frame}" is no frame that was seen')

    def _climb(
        self, source: str, target: str, time: int
    ) -> tuple[list[Transform], str | None, ExtrapolationError | None]:
        """Return the transforms from the source up, and where that ends; None as the end where it met the target."""
        chain: list[Transform] = []
        frame, gap = source, None
        while True:
            cache = self._caches.get(frame)
            if cache is None:
                return chain, frame, None
            try:
                one = cache.at(time)
            except ExtrapolationError as error:
                gap = error
                return chain, frame, gap
            if frame == target:
                return chain, None, None
            chain.append(one)
            frame = one.parent
            if len(chain) > _DEEPEST:
                raise LoopError(f'the frames above "{source}" are a loop')

    def _descend(
        self, target: str, source: str, top: str, time: int, gap: ExtrapolationError | None
    ) -> tuple[list[Transform] | None, list[Transform]] | None:
        """Return the transforms from the target up to where the source's end; None where they do not meet.

        The first of the pair is None where the source itself was met on the way.
        """
        chain: list[Transform] = []
        frame = target
        while frame != top:
            cache = self._caches.get(frame)
            if cache is None:
                break
            one = cache.at(time)
            if frame == source:
                return None, chain
            chain.append(one)
            frame = one.parent
            if len(chain) > _DEEPEST:
                raise LoopError(f'the frames above "{target}" are a loop')
        if frame != top:
            if gap is not None:
                raise gap
            return None
        return [], chain

    def latest_common_time(self, target: str, source: str) -> int:
        """Return the newest time at which all between two frames is known; 0 where all of it is static.

        Raises:
            LookupFrameError: there is a loop.
            ConnectivityError: the two are in two trees.
        """
        above: list[tuple[int, str]] = []
        for stamp, parent in self._newest(source):
            above.append((stamp, parent))
            if parent == target:
                return _least(time for time, _ in above)
        of_target: list[int] = []
        known = {parent for _, parent in above}
        common = ""
        for stamp, parent in self._newest(target):
            of_target.append(stamp)
            if parent in known:
                common = parent
                break
            if parent == source:
                return _least(of_target)
        if not common:
            raise ConnectivityError(f'"{target}" and "{source}" are in two trees')
        for stamp, parent in above:
            of_target.append(stamp)
            if parent == common:
                break
        return _least(of_target)

    def _newest(self, frame: str) -> Iterator[tuple[int, str]]:
        """Yield stamp and parent of the newest transform of a frame and of all frames above it."""
        first = frame
        for _ in range(_DEEPEST + 1):
            cache = self._caches.get(frame)
            stamp, parent = cache.newest() if cache is not None else (0, "")
            if not parent:
                return
            yield stamp, parent
            frame = parent
        raise LoopError(f'the frames above "{first}" are a loop')


def _least(stamps: Iterator[int] | list[int]) -> int:
    return min((one for one in stamps if one), default=0)


def _found(time: int, up: list[Transform] | None, down: list[Transform]) -> Found:
    """Join the transforms from the source up with the way down to the target."""
    translation, rotation = _joined(up or [])
    if down:
        over, turned = _joined(down)
        back = inverse(turned)
        moved = rotated(back, (-over[0], -over[1], -over[2]))
        translation, rotation = added(rotated(back, translation), moved), product(back, rotation)
    return Found(time, translation, rotation)


def _joined(chain: list[Transform]) -> _Pose:
    translation, rotation = ZERO, IDENTITY
    for one in chain:
        translation = added(rotated(one.rotation, translation), one.translation)
        rotation = product(one.rotation, rotation)
    return translation, rotation
