"""Which package of a workspace depends on which."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence

import msgspec

from roslens.model.relations.strongly_connected import strongly_connected
from roslens.model.source import OUTSIDE_PACKAGES, Dependency, Package

_NO_DEPENDENCY = frozenset({"conflict", "replace", "doc", "group"})


class DependencyGraph(msgspec.Struct, frozen=True):
    """The packages of a workspace as a graph.

    ``below`` maps the id of each package to the ids of those it depends on, sorted; ``declared`` to
    the names it declares, whether or not they are packages of the workspace. ``components`` are the
    strongly connected ones, each after all that it depends on.
    """

    below: dict[str, tuple[str, ...]]
    declared: dict[str, frozenset[str]]
    components: tuple[tuple[str, ...], ...]


def dependency_graph(packages: Sequence[Package]) -> DependencyGraph:
    """Return the graph of the packages; files outside packages are none.

    Build, export, run and test dependencies count alike where their condition holds; conflict,
    replace and doc do not. A dependency on a group is one on each of its members (REP-149). A name
    that two packages of the workspace have means both.
    """
    packages = sorted((package for package in packages if package.id != OUTSIDE_PACKAGES), key=lambda one: one.id)
    by_name: defaultdict[str, list[str]] = defaultdict(list)
    members: defaultdict[str, list[str]] = defaultdict(list)
    for package in packages:
        by_name[package.name].append(package.id)
        for group in _active(package.member_of_groups):
            members[group.name].append(package.name)
    declared: dict[str, frozenset[str]] = {}
    for package in packages:
        names = {one.name for one in _active(package.dependencies) if one.kind not in _NO_DEPENDENCY}
        for group in _active(package.dependencies):
            if group.kind == "group":
                names.update(member for member in members[group.name] if member != package.name)
        declared[package.id] = frozenset(names)
    below = {
        package.id: tuple(sorted(one for name in declared[package.id] for one in by_name.get(name, ())))
        for package in packages
    }
    components = tuple(tuple(sorted(one)) for one in strongly_connected(below, below.__getitem__))
    return DependencyGraph(below, declared, components)


def _active(dependencies: Iterable[Dependency]) -> list[Dependency]:
    return [one for one in dependencies if one.active]
