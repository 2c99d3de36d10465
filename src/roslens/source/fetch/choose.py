"""What of a distribution is wanted: all of it, or what a filter and the command line name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
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
    by_name = {one.name: one for one in distribution.repositories}
    groups: dict[str, list[Wanted]] = {}
    for one in distribution.repositories:
        groups.setdefault(one.name.partition("/")[0], []).append(one)
    picked: dict[str, tuple[str, ...] | None] = {}
    failures: list[Failure] = []

    def pick(name: str, names: tuple[str, ...] | None) -> None:
        for one in [by_name[name]] if name in by_name else groups.get(name, []):
            before = picked.get(one.name, ())
            picked[one.name] = None if names is None or before is None else tuple(dict.fromkeys((*before, *names)))
        if name not in by_name and name not in groups:
            failures.append(_unknown("repository", name, {*by_name, *groups}))

    for name, names in (chosen.packages if chosen else {}).items():
        pick(name, names or None)
    for name in repositories:
        pick(name, None)
    homes = {package: one.name for one in distribution.repositories for package in one.packages}
    for package in packages:
        # A repository of one package often has its name, and no release that would say so.
        home = homes.get(package) or (package if package in by_name else "")
        if home:
            pick(home, (package,))
        else:
            failures.append(_unknown("package", package, homes))
    commits = chosen.commits if chosen else {}
    wanted = [
        msgspec.structs.replace(by_name[name], packages=names or (), commits=commits.get(name, 0))
        for name, names in sorted(picked.items())
    ]
    return wanted, failures


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
