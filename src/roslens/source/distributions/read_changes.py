"""What distributions deprecated and removed: the tables ``changes/*.toml``, and what a row means for a target."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

from roslens.source.distributions.known_distributions import distributions, is_at_least
from roslens.source.distributions.target import Target

FOLDER = Path(__file__).with_name("changes")
"""Of the tables, one for each library or subject."""
BY_HAND = "by_hand.toml"
"""The table that is read last: its rows take the place of generated ones."""


class Kind(str, Enum):
    """What it is that changes; the names are those of the tables in a file."""

    HEADER = "header"
    CPP = "cpp"
    PYTHON = "python"
    MODULE = "module"
    CMAKE = "cmake"
    PACKAGE = "package"
    EXECUTABLE = "executable"
    PARAMETER = "parameter"
    PLUGIN = "plugin"


class Change(msgspec.Struct, frozen=True, omit_defaults=True, kw_only=True):
    """A row: something that a distribution deprecated, removed, or both.

    Attributes:
        kind: what it is.
        name: the path of a header, the name in code, the command, ``package/executable``, ``owner:parameter`` where the
            owner is the type of a plug-in or ``package/executable``, or the type of a plug-in.
        deprecated: the distribution that deprecated it; empty where it was removed at once.
        removed: the first distribution without it; empty where all have it.
        instead: what takes its place; empty for nothing.
        since: the first distribution that has what takes its place; empty where all that have the old one do.
        alike: ``instead`` takes its place as it is, and so may be written there.
        note: what else there is to do, a clause.
        source: who says so.
        ros: 1 or 2.
    """

    kind: Kind
    name: str
    deprecated: str = ""
    removed: str = ""
    instead: str = ""
    since: str = ""
    alike: bool = False
    note: str = ""
    source: str = ""
    ros: int = 2

    @property
    def key(self) -> str:
        """What tells it from all others."""
        return f"ros{self.ros} {self.kind.value} {self.name}"

    @property
    def first(self) -> str:
        """The distribution with which it begins to matter."""
        return self.deprecated or self.removed

    def text(self) -> str:
        """Return what happened to it, as messages say it, with what is expected."""
        parts = []
        if self.deprecated:
            parts.append(f"deprecated since {distributions()[self.deprecated].title}")
        if self.removed:
            parts.append(f"removed in {distributions()[self.removed].title}")
        note = f" ({self.note})" if self.note else ""
        return f"{' and '.join(parts)}; expected {f'`{self.instead}`' if self.instead else 'none'}{note}"


class Effect(Enum):
    """What a row means for a target, from mildest."""

    NONE = 0
    DEPRECATED = 1
    LATER = 2
    """No target is known, and a distribution that it may be for does not have it any more."""
    REMOVED = 3


def effect_of(change: Change, target: Target) -> Effect:
    """Return what a row means for a target; one without distributions of that version of ROS is an unknown one."""
    names = target.of(change.ros)
    if not names:
        oldest = target.oldest(change.ros)
        if change.removed:
            return Effect.REMOVED if is_at_least(oldest, change.removed) else Effect.LATER
        return Effect.DEPRECATED
    gone = [bool(change.removed) and is_at_least(one, change.removed) for one in names]
    # Whoever reads that it is for several may be told of the past, too.
    if all(gone) if target.told else any(gone):
        return Effect.REMOVED
    if change.deprecated and any(is_at_least(one, change.deprecated) for one in names):
        return Effect.DEPRECATED
    # What people are told may be older than the code: it is looked at as what will break.
    return Effect.LATER if change.removed and target.told else Effect.NONE


@cache
def read_changes() -> Mapping[str, Change]:
    """Return all rows by their keys.

    Raises:
        ValueError: a table has a kind, a field or a distribution that does not exist, or a row twice.
    """
    import tomli

    rows: dict[tuple[str, str, int], dict[str, Any]] = {}
    for path in (*sorted(one for one in FOLDER.glob("*.toml") if one.name != BY_HAND), FOLDER / BY_HAND):
        document = tomli.loads(path.read_text("utf-8"))
        about = {"source": "", "ros": 2, **document.pop("about", {})}
        for kind, named in document.items():
            for name, row in named.items():
                key = (kind, name, about["ros"])
                if key in rows and path.name != BY_HAND:
                    raise ValueError(f"{path.name}: {kind} {name!r} stands in two tables")
                rows[key] = {**about, **row}
    changes = (_change(Kind(kind), name, row) for (kind, name, _), row in rows.items())
    return {one.key: one for one in changes}


def _change(kind: Kind, name: str, row: Mapping[str, Any]) -> Change:
    change = msgspec.convert({"kind": kind, "name": name, **row}, Change)
    for one in (change.deprecated, change.removed, change.since):
        if one and one not in distributions():
            raise ValueError(f"{change.key!r}: there is no distribution {one!r}")
    return change


@cache
def changes_of(kind: Kind) -> Mapping[str, tuple[Change, ...]]:
    """Return the rows of a kind by their names: one for each version of ROS that has one."""
    found: dict[str, tuple[Change, ...]] = {}
    for one in read_changes().values():
        if one.kind is kind:
            found[one.name] = (*found.get(one.name, ()), one)
    return found


def rows_of(kind: Kind, *, ros: int) -> tuple[Change, ...]:
    """Return the rows of a kind for a version of ROS, in the order of the tables."""
    return tuple(one for one in read_changes().values() if one.kind is kind and one.ros == ros)
