"""Rule ``package.misspelt_dependency``: the name of a dependency is almost that of a package of ROS."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches
from functools import lru_cache

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.system_packages import OF_THE_CORE

MOST = 500
"""Dependencies that are looked at."""
SHORTEST = 10
"""Letters; shorter names differ by one letter and mean two packages (``mav_msgs``, ``map_msgs``)."""
_ALIKE = 0.95
_OTHERS = frozenset({"ddynamic_reconfigure"})
"""Packages of these names that are not of the core of ROS."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each dependency that no package has and that differs by a letter from one of ROS."""
    reported: set[str] = set()
    for one in view.package.dependencies[:MOST]:
        name = one.name
        if (
            name in OF_THE_CORE
            or name in _OTHERS
            or name in reported
            or len(name) < SHORTEST
            or one.kind in ("conflict", "replace", "group")
        ):
            continue
        if (close := _close(name)) and not _is_used(name, view):
            reported.add(name)
            where = one.location
            message = f"dependency {name!r}; meant {close!r}?"
            yield Hit("package.misspelt_dependency", message, where.line, where.column, context=name, path=where.path)


def _is_used(name: str, view: PackageView) -> bool:
    """Return whether a source of the package imports or includes exactly that name: then it is meant."""
    written = (each for facts in view.facts.values() for each, _ in facts.includes)
    return any(re.split(r"[./]", each.strip('<>"'), maxsplit=1)[0] == name for each in written)


@lru_cache(maxsize=4096)
def _close(name: str) -> str:
    """Return the package of ROS that is almost of this name; empty for none."""
    close = next(iter(get_close_matches(name, OF_THE_CORE, 1, _ALIKE)), "")
    return close if close and _digits(close) == _digits(name) else ""


def _digits(name: str) -> str:
    return "".join(filter(str.isdigit, name))


RULE = PackageRule(
    id="package.misspelt_dependency",
    title="Dependency whose name is misspelt",
    finds="A dependency of at least ten letters that differs by one letter from a package of the core of ROS: "
    "`sensor_msg`, `geomety_msgs`. A name that the package's own code imports or includes is meant.",
    why="rosdep finds nothing of that name and stops, or with `-r` leaves the package out; the workspace "
    "builds where the right one happens to be installed.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("manifest", "dependency"),
    bad="<depend>geomety_msgs</depend>",
    good="<depend>geometry_msgs</depend>",
    found=found,
)
