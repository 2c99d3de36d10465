"""What of a distribution is wanted: all of it, or what a filter and the command line name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches

import msgspec

from roslens.model.failure import Failure
from roslens.source.fetch.distribution import Distribution
from roslens.source.fetch.filter_file import Filter
from roslens.source.fetch.wanted import Wanted


def choose(
    distribution: Distribution, chosen: Filter | None, packages: Sequence[str], repositories: Sequence[str]
) -> tuple[list[Wanted], list[Failure]]:
    """Return the repositories that are wanted, by name, and names that nothing has.

    Args:
        distribution: all there is.
        chosen: what a filter file says.
        packages: names of packages; of their repositories only they are wanted.
        repositories: names of repositories, wanted as a whole.
    """
    if chosen is None and not packages and not repositories:
        whole = (one if distribution.chosen else _whole(one) for one in distribution.repositories)
        return list(whole), []
    choice = _Choice(distribution)
    if chosen is not None:
        for name, names in chosen.packages.items():
            choice.pick(name, names or None)
    for name in repositories:
        choice.pick(name, None)
    for package in packages:
        choice.pick_package(package)
    return choice.wanted(chosen.commits if chosen else {}), choice.failures


class _Choice:
    """What was picked of a distribution so far."""

    def __init__(self, distribution: Distribution) -> None:
        self.failures: list[Failure] = []
        self._by_name = {one.name: one for one in distribution.repositories}
        self._groups: dict[str, list[Wanted]] = {}
        for one in distribution.repositories:
            self._groups.setdefault(one.name.partition("/")[0], []).append(one)
        self._homes = {package: one.name for one in distribution.repositories for package in one.packages}
        self._picked: dict[str, tuple[str, ...] | None] = {}

    def pick(self, name: str, packages: tuple[str, ...] | None) -> None:
        """Pick a repository, or all of a group; None for all of its packages."""
        by_name, groups, picked = self._by_name, self._groups, self._picked
        for one in [by_name[name]] if name in by_name else groups.get(name, []):
            before = picked.get(one.name, ())
            whole = packages is None or before is None
            picked[one.name] = None if whole else tuple(dict.fromkeys((*(before or ()), *(packages or ()))))
        if name not in by_name and name not in groups:
            self.failures.append(_unknown("repository", name, {*by_name, *groups}))

    def pick_package(self, package: str) -> None:
        """Pick a package of its repository."""
        # A repository of one package often has its name, and no release that would show it.
        home = self._homes.get(package) or (package if package in self._by_name else "")
        if home:
            self.pick(home, (package,))
        else:
            self.failures.append(_unknown("package", package, self._homes))

    def wanted(self, commits: Mapping[str, int]) -> list[Wanted]:
        """Return what was picked, by name; ``commits`` is how much of the history some of it needs."""
        return [
            msgspec.structs.replace(self._by_name[name], packages=packages or (), commits=commits.get(name, 0))
            for name, packages in sorted(self._picked.items())
        ]


def _whole(wanted: Wanted) -> Wanted:
    return msgspec.structs.replace(wanted, packages=())


def _unknown(kind: str, name: str, known: Iterable[str]) -> Failure:
    near = get_close_matches(name, list(known), 3, 0.6)
    return Failure(
        "fetch",
        f"the distribution has no {kind} {name!r}",
        f"one of its {'repositories' if kind == 'repository' else 'packages'}",
        f"Did you mean {' or '.join(near)}?" if near else "Check the name and the distribution",
        entity=f"{kind}:{name}",
    )
