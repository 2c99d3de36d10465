"""Modules of Python by the names that they are imported by, and what an imported name may mean in them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from roslens.source.extract.facts.files import folders_in_common
from roslens.source.extract.ir.program import Program
from roslens.source.extract.symbols.linkage import Linkage

_DEEPEST = 4
"""So many packages may hand on a name."""


class PythonModules:
    """The modules of a workspace; a module has each suffix of its path, as the location of packages is unknown."""

    def __init__(self, programs: Mapping[str, Program], outer: Collection[str], linkage: Linkage) -> None:
        """Begin without modules; names in ``outer`` are those of the vocabulary and mean no module of the workspace."""
        self._programs = programs
        self._outer = outer
        self._linkage = linkage
        self._paths: dict[str, list[str]] = {}

    def add(self, path: str) -> None:
        """Add a file; a script without an ending cannot be imported, though it be named like the package beside it."""
        if path.endswith(".py"):
            pieces = path.removesuffix(".py").removesuffix("/__init__").split("/")
            for place in range(len(pieces)):
                self._paths.setdefault(".".join(pieces[place:]), []).append(path)

    def imported(self, name: str, path: str, depth: int = 0) -> Iterator[str]:
        """Yield what a name may mean by what a file imports: the file of the module and the name there.

        What a package imports it hands on: ``from robot import Arm`` where its ``__init__.py`` has ``Arm`` of a module.
        """
        program = self._programs[path]
        head, dot, rest = name.partition(".")
        meanings = [program.imports[head] + dot + rest] if head in program.imports else []
        for meaning in [*meanings, *(f"{using}.{name}" for using in program.using)]:
            if meaning in self._outer:
                return
            pieces = meaning.strip(".").split(".")
            for place in range(len(pieces) - 1, 0, -1):
                near = self._nearest(pieces[:place], path)
                if near:
                    inside = ".".join(pieces[place:])
                    yield f"{near}:{inside}"
                    if depth < _DEEPEST and near != path and near.endswith("/__init__.py"):
                        yield from self.imported(inside, near, depth + 1)

    def _nearest(self, module: list[str], path: str) -> str:
        """Return the file that a module means that a file imports; empty where it is none that the file knows.

        That is one of its own package, of one that this depends on, or of a package of Python by the name of its own.
        Scripts see modules beside them by their plain name: of several elsewhere nobody knows which is meant.
        """
        found = [one for one in self._paths.get(".".join(module), ()) if self._may_import(path, one, module[0])]
        if not found:
            return ""
        near = max(found, key=lambda one: (folders_in_common(one, path), -len(one)))
        if len(module) > 1 or len(found) == 1 or near.rpartition("/")[0] == path.rpartition("/")[0]:
            return near
        same = [one for one in found if folders_in_common(one, path) == folders_in_common(near, path)]
        return near if len(same) == 1 else ""

    def _may_import(self, path: str, other: str, head: str) -> bool:
        owner = self._linkage.package(other)
        return self._linkage.depends(path, other) or head == owner.rpartition("/")[2]
