"""Past revisions as pages show them: how quantities went, and what is different between two of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache

from roslens.compare.run_difference import RunDifference, RunSide, run_difference
from roslens.model.trend import Trend, TrendEvent, TrendPoint
from roslens.store.read import RunView
from roslens.store.trends import Trends

Commits = tuple[tuple[str, str], ...]
Renamed = Callable[[Commits, Commits], Mapping[str, str]]
"""Returns, of the commits of two points, the later path of each file that has another one, by the earlier."""


class Past:
    """The revisions of a workspace, the earliest first, with the tree of today where it is none of them."""

    def __init__(self, trends: Trends, renamed: Renamed) -> None:
        """Take loaded trends, and a source of renamed files."""
        self._trends = trends
        self._renamed = renamed
        self.trend = lru_cache(maxsize=256)(trends.of)
        self.difference = lru_cache(maxsize=32)(self._difference)

    @property
    def points(self) -> tuple[TrendPoint, ...]:
        """The revisions."""
        return self._trends.points

    @property
    def events(self) -> tuple[TrendEvent, ...]:
        """Releases, and changes of what measures and judges."""
        return self._trends.events

    @property
    def keys(self) -> tuple[str, ...]:
        """What can be followed."""
        return self._trends.keys

    def known(self, key: str) -> Trend | None:
        """Return the trend of a quantity; None for one that was not measured."""
        return self.trend(key) if key in self.keys else None

    def place_of(self, name: str) -> int | None:
        """Return the place of a revision by its commit, the beginning of it, or the name of a release."""
        return next(
            (
                place
                for place, one in enumerate(self.points)
                if name and (one.commit.startswith(name) or one.name == name)
            ),
            None,
        )

    @property
    def last_release(self) -> int | None:
        """The place of the newest release before the last point; None where there is none."""
        released = {one.point for one in self.events if one.kind == "release"}
        return max((place for place in released if place < len(self.points) - 1), default=None)

    def _difference(self, before: int, after: int) -> RunDifference:
        views = self._trends.views
        old, new = (_side(views[place]) for place in (before, after))
        commits = (self._trends.commits[place] for place in (before, after))
        return run_difference(old, new, self._renamed(*commits))


def _side(view: RunView) -> RunSide:
    header = view.header
    return RunSide(tuple(view.findings()), view.packages(), {**header.tools, "models": ", ".join(header.models)})
