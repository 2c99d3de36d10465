"""Which class of a Python package a name means that was imported from where it was imported itself."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence

_DEEPEST = 5
"""So many packages may hand on a name."""


class Reexports:
    """The modules of a package and what they import.

    An ``__init__.py`` hands on what it imports: ``from robot import Arm`` and ``robot.Arm`` mean the class of
    ``robot.arm`` where the package imports from that.
    """

    def __init__(self, modules: Mapping[str, Sequence[str]], packages: Iterable[str]) -> None:
        """Take the modules by their full name, with the modules that each imports as written.

        Args:
            modules: full names, joined by dots.
            packages: those of them that are an ``__init__.py``.
        """
        self._modules = modules
        self._packages = frozenset(packages)
        self._by_last: defaultdict[str, list[str]] = defaultdict(list)
        for name in modules:
            self._by_last[name.rpartition(".")[2]].append(name)

    def find(self, name: str, module: str, candidates: Sequence[str]) -> str | None:
        """Return which of several classes a name means in a module; None where that stays open.

        Args:
            name: as written.
            module: full name of where it is written.
            candidates: full names of the classes whose last part is that of the name.
        """
        if not candidates or module not in self._modules:
            return None
        before = name.rpartition(".")[0]
        written = (before,) if before else self._modules[module]
        seen = self._handed_on(one for home in written for one in self._whole(home, module))
        found = [one for one in candidates if one.rpartition(".")[0] in seen]
        return found[0] if len(found) == 1 else None

    def _whole(self, written: str, module: str) -> tuple[str, ...]:
        """Return the full names of what an import means: those that end with it, of a relative one the one below."""
        dots = len(written) - len(written.lstrip("."))
        if not dots:
            ending = f".{written}"
            several = self._by_last.get(written.rpartition(".")[2], ())
            return tuple(one for one in several if one == written or one.endswith(ending))
        around = module.split(".")
        kept = len(around) - dots + (module in self._packages)
        whole = ".".join([*around[: max(kept, 0)], *filter(None, [written[dots:]])])
        return (whole,) if whole in self._modules else ()

    def _handed_on(self, modules: Iterable[str]) -> set[str]:
        """Return modules and those from which they, being packages, may have what they are asked for."""
        seen: set[str] = set()
        waiting = [(one, 0) for one in modules]
        while waiting:
            one, depth = waiting.pop()
            if one in seen:
                continue
            seen.add(one)
            if one in self._packages and depth < _DEEPEST:
                waiting += [(inner, depth + 1) for written in self._modules[one] for inner in self._whole(written, one)]
        return seen
