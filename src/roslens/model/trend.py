"""How a quantity went over the revisions of a workspace."""

from __future__ import annotations

import msgspec


class TrendPoint(msgspec.Struct, frozen=True, omit_defaults=True):
    """A run that a trend goes through.

    Attributes:
        run: its number in the store that holds it.
        commit: that it is of; with ``+`` where the tree differed from it, empty where that is not known.
        time_s: when that was committed, in seconds since 1970; of a tree that is not committed, when it was analysed.
        name: the release that it is, ``now`` for the tree as it was analysed last, else the beginning of the commit.
        now: whether the run is of the tree and not of a past revision; its number is one of another store.
    """

    run: int
    commit: str
    time_s: float
    name: str
    now: bool = False


class TrendEvent(msgspec.Struct, frozen=True):
    """What happened between a point and the one before it.

    Attributes:
        point: its place among the points.
        kind: ``release``; ``moved``, packages that are in another folder; or ``tools``, ``models`` or ``settings``:
            what measured or judged was another, so a step here may not come from the source.
        text: which.
    """

    point: int
    kind: str
    text: str


class Trend(msgspec.Struct, frozen=True):
    """A quantity over the points.

    Attributes:
        quantity: key.
        title: as readers call it.
        unit: of the values.
        whole_is: how ``whole`` is made: ``sum`` or ``median`` of the packages, ``repository``, which has its own, or
            ``repository_sum`` or ``repository_median`` of several.
        points: the earliest first.
        packages: values by package id, a place for each point; None where it has none.
        whole: of all packages together.
        events: in order of their points.
        repositories: values by place of the repository, where there are several that have some.
    """

    quantity: str
    title: str
    unit: str
    whole_is: str
    points: tuple[TrendPoint, ...]
    packages: dict[str, tuple[float | None, ...]]
    whole: tuple[float | None, ...]
    events: tuple[TrendEvent, ...]
    repositories: dict[str, tuple[float | None, ...]] = {}
