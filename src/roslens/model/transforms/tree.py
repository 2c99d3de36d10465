"""The tree that transforms come to: each frame with its parents, and what is wrong with its time line."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from statistics import median

import msgspec

from roslens.model.transforms.transform import Transform

_SECOND = 1e9
AHEAD_S = 0.1
"""A stamp that is further ahead of its receipt lies in the future; less is the difference of two clocks."""
OTHER_CLOCK_S = 3600.0
"""Stamps that are so far from their receipt are of another clock, as of a simulation."""


class FrameLine(msgspec.Struct, frozen=True):
    """What was said of a frame; times in seconds.

    Attributes:
        child: the frame.
        parents: each with how often it was said; that of the newest transform last.
        static: whether its first transform was said on /tf_static, which decides how tf2 keeps it.
        received: when its transforms came, those that tf2 ignores left out.
        age: median of receipt less stamp; 0 of a static one.
        oldest: the largest of these ages.
        ahead: by how much the furthest stamp lies after its receipt; 0 where none does.
        back: how many stamps were before the one that came before it.
        authorities: nodes that said it, as far as known.
        flaws: why transforms of it are ignored, each with how often.
    """

    child: str
    parents: tuple[tuple[str, int], ...]
    static: bool
    received: tuple[float, ...] = ()
    age: float = 0.0
    oldest: float = 0.0
    ahead: float = 0.0
    back: int = 0
    authorities: tuple[str, ...] = ()
    flaws: tuple[tuple[str, int], ...] = ()

    @property
    def parent(self) -> str:
        """The parent by its newest transform; empty where all were ignored."""
        return self.parents[-1][0] if self.parents else ""

    @property
    def is_of_another_clock(self) -> bool:
        """Whether its stamps are of another clock than their receipt."""
        return abs(self.age) > OTHER_CLOCK_S


class TransformTree(msgspec.Struct, frozen=True):
    """All frames that were said, by name; ``frames`` has those too that are parents alone."""

    lines: dict[str, FrameLine]
    frames: frozenset[str] = frozenset()

    def above(self, frame: str) -> tuple[str, ...]:
        """Return a frame and all above it, by their newest parents; of a loop each frame once."""
        chain = [frame]
        while (line := self.lines.get(chain[-1])) is not None and line.parent and line.parent not in chain:
            chain.append(line.parent)
        return tuple(chain)

    def root(self, frame: str) -> str:
        """Return the frame at the top of a frame's tree."""
        return self.above(frame)[-1]

    def loop(self, frame: str) -> tuple[str, ...]:
        """Return the loop that the frames above a frame come to; nothing where they have a top."""
        chain = self.above(frame)
        line = self.lines.get(chain[-1])
        return chain[chain.index(line.parent) :] if line is not None and line.parent else ()

    def way(self, target: str, source: str) -> tuple[str, ...]:
        """Return the frames from the source to the target; nothing where they are in two trees."""
        up, down = self.above(source), self.above(target)
        common = next((one for one in up if one in down), None)
        if common is None:
            return ()
        return (*up[: up.index(common) + 1], *reversed(down[: down.index(common)]))

    def between(self, target: str, source: str) -> tuple[FrameLine, ...]:
        """Return the lines of the frames whose transforms lie between two frames."""
        up, down = self.above(source), self.above(target)
        common = next((one for one in up if one in down), None)
        if common is None:
            return ()
        names = (*up[: up.index(common)], *down[: down.index(common)])
        return tuple(self.lines[one] for one in names)

    def trees(self) -> dict[str, int]:
        """Return the top of each tree with how many frames it has, the largest first."""
        counts = Counter(self.root(one) for one in self.frames)
        return dict(sorted(counts.items(), key=lambda one: (-one[1], one[0])))


class _Said:
    """What was said of a frame so far."""

    def __init__(self, first: Transform) -> None:
        self.child, self.static = first.child, first.static
        self.parents: dict[str, int] = {}
        self.received: list[float] = []
        self.ages: list[float] = []
        self.back = 0
        self.last = 0
        self.authorities: set[str] = set()
        self.flaws: Counter[str] = Counter()

    def add(self, one: Transform) -> None:
        if one.authority:
            self.authorities.add(one.authority)
        if flaw := one.flaw:
            self.flaws[flaw] += 1
            return
        # The newest is last.
        self.parents[one.parent] = self.parents.pop(one.parent, 0) + 1
        self.received.append(one.received / _SECOND)
        if not self.static:
            self.ages.append((one.received - one.stamp) / _SECOND)
            self.back += one.stamp < self.last
            self.last = one.stamp

    def line(self) -> FrameLine:
        ages = self.ages or [0.0]
        ahead = -min(ages)
        return FrameLine(
            self.child, tuple(self.parents.items()), self.static, tuple(self.received), median(ages), max(ages),
            ahead if AHEAD_S < ahead < OTHER_CLOCK_S else 0.0, self.back, tuple(sorted(self.authorities)),
            tuple(sorted(self.flaws.items())),
        )  # fmt: skip


def tree_of(transforms: Iterable[Transform]) -> TransformTree:
    """Return the tree that transforms come to, in order of receipt."""
    said: dict[str, _Said] = {}
    frames: set[str] = set()
    for one in transforms:
        if one.child:
            said.setdefault(one.child, _Said(one)).add(one)
            frames.add(one.child)
        if one.parent:
            frames.add(one.parent)
    return TransformTree({name: one.line() for name, one in sorted(said.items())}, frozenset(frames))
