"""Which packages of a workspace depend on which, also through others."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from roslens.model.source import Package

_NO_ORDER = frozenset({"doc", "conflict", "replace", "group"})
"""Kinds of dependencies that put no package before another."""
_OF_BUILD = frozenset({"build", "buildtool", "test", "depend"})

Dependents = tuple[tuple[str, bool], ...]


def dependents_of(packages: Sequence[Package]) -> Mapping[str, Dependents]:
    """Return the packages that depend on each, also through others, by its name.

    With each stands whether the way from it has a dependency of a build or a test: without one catkin orders packages
    that depend on each other (catkin_pkg/topological_order.py), colcon orders none
    (colcon_core/topological_order.py).
    """
    bits = {name: 1 << place for place, name in enumerate(sorted({one.name for one in packages}))}
    # Sets of packages are bits of a number: `any_way` those that lead to one, `built` those that do with a build.
    any_way, built = dict.fromkeys(bits, 0), dict.fromkeys(bits, 0)
    asked = _asked(packages, bits)
    changed = True
    while changed:
        changed = False
        for name, by in asked.items():
            before = any_way[name], built[name]
            for other, is_of_build in by.items():
                leads = bits[other] | any_way[other]
                any_way[name] |= leads
                built[name] |= leads if is_of_build else built[other]
            changed = changed or before != (any_way[name], built[name])
    return {
        name: tuple((other, bool(built[name] & bit)) for other, bit in bits.items() if any_way[name] & bit)
        for name in bits
    }


def _asked(packages: Sequence[Package], known: Collection[str]) -> Mapping[str, Mapping[str, bool]]:
    """Return which packages declare each, and whether for a build."""
    asked: dict[str, dict[str, bool]] = {}
    for one in packages:
        for dependency in one.dependencies:
            name = dependency.name
            if name in known and name != one.name and dependency.active and dependency.kind not in _NO_ORDER:
                by = asked.setdefault(name, {})
                by[one.name] = by.get(one.name, False) or dependency.kind in _OF_BUILD
    return asked
