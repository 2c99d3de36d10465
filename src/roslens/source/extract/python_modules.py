"""Modules of Python by the names that they are imported by, and what an imported name may mean in them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from roslens.source.extract.files import folders_in_common
from roslens.source.extract.program import Program

_DEEPEST = 4
"""So many packages may hand on a name."""


class PythonModules:
    """The modules of a workspace; a module is known by each end of its path, as nobody knows where packages are put."""

    def __init__(self, programs: Mapping[str, Program], outer: Collection[str]) -> None:
        """Begin without modules; names in ``outer`` are those of the vocabulary and mean no module of the workspace."""
        self._programs = programs
        self._outer = outer
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
                found = self._paths.get(".".join(pieces[:place]))
                if found:
                    near = max(found, key=lambda one: (folders_in_common(one, path), -len(one)))
                    inside = ".".join(pieces[place:])
                    yield f"{near}:{inside}"
                    if depth < _DEEPEST and near != path and near.endswith("/__init__.py"):
                        yield from self.imported(inside, near, depth + 1)
