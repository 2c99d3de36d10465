"""Filter files of the first paper: which packages of which repositories, with the state that each was in."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec

from roslens.model.errors import UsageError


class Filter(msgspec.Struct, frozen=True):
    """A choice among the packages of a distribution.

    Attributes:
        packages: wanted ones, by the name of their repository; none means all of it.
        commits: by the name of a repository, how many commits it had.
        levels: by the name of a package, what role it was given: 1 driver, 2 library, 3 application.
    """

    packages: dict[str, tuple[str, ...]]
    commits: dict[str, int] = {}
    levels: dict[str, int] = {}


def filter_of(data: Mapping[str, Any], place: str) -> Filter:
    """Return the content of a filter file.

    Args:
        data: values of the document.
        place: its path, for messages.

    Raises:
        UsageError: it is none.
    """
    packages = data.get("packages")
    if not isinstance(packages, Mapping) or not packages:
        raise _wrong(place, "it has no table `packages`")
    wanted: dict[str, tuple[str, ...]] = {}
    for name, names in packages.items():
        if names is not None and not isinstance(names, list):
            raise _wrong(place, f"packages.{name} is not a list of names")
        wanted[str(name)] = tuple(dict.fromkeys(str(one) for one in names or ()))
    commits: dict[str, int] = {}
    levels: dict[str, int] = {}
    facts_of = data.get("meta") or {}
    if not isinstance(facts_of, Mapping):
        raise _wrong(place, "meta is not a table")
    for name, facts in facts_of.items():
        if not isinstance(facts, Mapping):
            raise _wrong(place, f"meta.{name} is not a table")
        if (count := facts.get("commits")) is not None:
            commits[str(name)] = _commits(count, str(name), place)
        levels.update(_levels(facts.get("levels") or {}, str(name), place))
    return Filter(wanted, commits, levels)


def _commits(count: object, name: str, place: str) -> int:
    if not isinstance(count, int) or isinstance(count, bool) or count < 1:
        raise _wrong(place, f"meta.{name}.commits is {count!r}")
    return count


def _levels(given: object, name: str, place: str) -> dict[str, int]:
    if not isinstance(given, Mapping) or not all(isinstance(level, int) for level in given.values()):
        raise _wrong(place, f"meta.{name}.levels is not a table of numbers")
    return {str(package): level for package, level in given.items()}


def _wrong(place: str, what: str) -> UsageError:
    return UsageError(
        f'"{place}" is not a filter file: {what}',
        expected="packages: {REPOSITORY: [PACKAGE, …]}, and meta: {REPOSITORY: {commits: N, levels: {…}}}",
    )
