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
        path = [start]
        on_path = {start}
        while path:
            name = path[-1]
            above = parents.get(name, frozenset())
            unknown = next((one for one in sorted(above) if one not in found and one not in on_path), None)
            if unknown is not None:
                path.append(unknown)
                on_path.add(unknown)
                continue
            known = [found[one] for one in above if one in found]
            found[name] = 1 + max(known, default=0) if above else 0
            on_path.discard(path.pop())
    return found
