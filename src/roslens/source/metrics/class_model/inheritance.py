"""How deep classes stand below their ancestors."""

from __future__ import annotations

from collections.abc import Mapping, Set


def depths(parents: Mapping[str, Set[str]]) -> dict[str, int]:
    """Return for each class the length of its longest way up.

    A parent that is no key has depth 0. A class that is its own ancestor, which no compiler takes but
    names alone may suggest, does not count a second time on its way up.
    """
    found: dict[str, int] = {}
    for start in parents:
        path = [] if start in found else [start]
        on_path = set(path)
        while path:
            above = parents[path[-1]]
            unknown = min(
                (one for one in above & parents.keys() if one not in found and one not in on_path), default=""
            )
            if unknown:
                path.append(unknown)
                on_path.add(unknown)
                continue
            name = path.pop()
            on_path.discard(name)
            found[name] = 1 + max((found.get(one, 0) for one in above), default=-1)
    return found
