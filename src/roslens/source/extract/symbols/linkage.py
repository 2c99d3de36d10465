"""Which definitions code of C++ can mean: those of its own file and what it includes, then what it is linked with.

Functions of one name in other programs are others: what is ``static`` or in a namespace without name is known to its
own file only, and a source that no target links together with the one that calls is no answer at all.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from enum import IntEnum
from types import MappingProxyType

from roslens.model.source import OUTSIDE_PACKAGES
from roslens.source.extract.facts.node_facts import Target, TargetKind
from roslens.source.extract.ir.program import Program
from roslens.source.extract.symbols.included_files import HEADERS, Needs, Packages, included_files, inverted, reached


class Near(IntEnum):
    """How a file knows what another one defines, the surest first."""

    OWN = 0
    INCLUDED = 1
    BESIDE = 2
    LINKED = 3
    DEPENDED_ON = 4


class Linkage:
    """What files of C++ know of each other, by what they include and by the targets that they are parts of."""

    def __init__(
        self,
        programs: Mapping[str, Program],
        packages: Packages = MappingProxyType({}),
        needs: Needs = MappingProxyType({}),
        targets: Iterable[Target] = (),
    ) -> None:
        """Read nothing yet.

        Args:
            programs: of the workspace, by path.
            packages: of each file; by default its first folder.
            needs: what packages depend on.
            targets: that builds make.
        """
        self._programs, self._packages, self._needs = programs, packages, needs
        self._targets: dict[str, set[int]] = {}
        self._libraries: set[str] = set()
        for number, target in enumerate(targets):
            for path in target.sources:
                self._targets.setdefault(path, set()).add(number)
                if target.kind is TargetKind.LIBRARY:
                    self._libraries.add(path)
        self._included: dict[str, tuple[str, ...]] | None = None
        self._including: dict[str, set[str]] = {}
        self._sees: dict[str, set[str]] = {}
        self._units: dict[str, set[str]] = {}
        self._known: dict[tuple[str, str, str], Near | None] = {}

    def near(self, path: str, other: str, unit: str = "", *, local: bool = False) -> Near | None:
        """Return how code in a file knows what another file defines for all; None where it does not.

        Args:
            path: of the file with the code.
            other: of the file with the definition.
            unit: the file of the program of which the code is a part; empty where that is not known.
            local: whether the definition holds in its own file only, and where that is included.
        """
        if path == other:
            return Near.OWN
        key = path, other, unit
        if key not in self._known:
            self._known[key] = self._near(path, other, unit)
        found = self._known[key]
        return None if local and found is not None and found > Near.BESIDE else found

    def _near(self, path: str, other: str, unit: str) -> Near | None:
        if other in self.seen(path):
            return Near.INCLUDED
        units = self.units(path)
        if any(other in self.seen(one) for one in units):
            return Near.BESIDE
        if other.endswith(HEADERS):
            return None
        parts = set[int]().union(*(self._targets.get(one, ()) for one in units))
        parts = parts & self._targets.get(unit, set()) or parts
        home = self._targets.get(other, set())
        if parts & home:
            return Near.LINKED
        package, owner = self.package(path), self.package(other)
        if package == owner:
            # It is unknown where sources belong that no build names.
            return None if parts and home else Near.DEPENDED_ON
        library = other in self._libraries or not home
        sees = any(self.package(one) == owner for each in units for one in self.seen(each))
        return Near.DEPENDED_ON if library and sees else None

    def may_know(self, path: str, other: str) -> bool:
        """Return whether a file may know anything of another one: by its package, what that needs, or an include."""
        owner = self.package(other)
        if self.depends(path, other):
            return True
        return any(self.package(one) == owner for each in self.units(path) for one in self.seen(each))

    def depends(self, path: str, other: str) -> bool:
        """Return whether two files are of one package, or the package of the first one depends on the other's."""
        package, owner = self.package(path), self.package(other)
        return package == owner or owner in self._needs.get(package, ())

    def package(self, path: str) -> str:
        """Return the package of a file; of one outside of packages its folder."""
        found = self._packages.get(path) or path.partition("/")[0]
        return path.rpartition("/")[0] if found == OUTSIDE_PACKAGES else found

    def seen(self, path: str) -> set[str]:
        """Return the files that a file includes, directly or not, and itself."""
        if path not in self._sees:
            self._sees[path] = reached(path, self._edges())
        return self._sees[path]

    def units(self, path: str) -> set[str]:
        """Return the sources that are compiled with a file in them: itself, or what includes a header."""
        if path not in self._units:
            self._edges()
            found = {one for one in reached(path, self._including) if not one.endswith(HEADERS)}
            self._units[path] = found or {path}
        return self._units[path]

    def _edges(self) -> dict[str, tuple[str, ...]]:
        if self._included is None:
            self._included = included_files(self._programs, self._packages, self._needs)
            self._including = inverted(self._included)
        return self._included
