"""What a name without its namespace means by namespaces and modules that are used whole, where no file defines it.

``using namespace actionlib;`` lets ``SimpleActionClient`` mean that of actionlib, in the file and in what includes it;
``from rospy import *`` lets ``Publisher`` mean that of rospy, and a module of the workspace hands on what it imports.
Only names of the vocabulary are looked for: what else there may be in a namespace is unknown.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import cached_property

from roslens.source.extract.ir.program import Program
from roslens.source.extract.symbols.included_files import HEADERS, Needs, Packages, including, reached

_DEEPEST = 4
"""So many modules may hand on a name."""


class UsedNames:
    """The namespaces and modules that files use whole."""

    def __init__(
        self, programs: Mapping[str, Program], outer: Collection[str], packages: Packages, needs: Needs
    ) -> None:
        """Look for names in ``outer``, which are whole and joined by dots."""
        self._programs = programs
        self._outer = outer
        self._packages = packages
        self._needs = needs
        self._lasts = frozenset(part for name in outer for part in name.split("."))

    def meant(self, name: str, path: str, scopes: Collection[str]) -> str:
        """Return the whole name that a name means by what is used whole in a file; empty where it means none.

        Args:
            name: as written, joined by dots.
            path: of the file.
            scopes: what may stand before it, each with its dot, the innermost first.
        """
        program = self._programs.get(path)
        if program is None or name.partition(".")[0] not in self._lasts or name in self._outer:
            return ""
        if program.language == "python":
            return next((one for one in self._imported(name, program, 0) if one in self._outer), "")
        spaces = (*program.using, *self._by_headers.get(path, ()))
        whole = (*(f"{before}{name}" for before in scopes), *(f"{using}.{name}" for using in spaces))
        return next((one for one in whole if one in self._outer), "")

    @cached_property
    def _by_headers(self) -> Mapping[str, tuple[str, ...]]:
        """The namespaces that the headers of the workspace use whole which a file includes, directly or not."""
        spaces = {name.rpartition(".")[0] for name in self._outer}
        using = {
            path: known
            for path, program in self._programs.items()
            if path.endswith(HEADERS) and (known := [one for one in program.using if one in spaces])
        }
        if not using:
            return {}
        includers = including(self._programs, self._packages, self._needs)
        found: dict[str, tuple[str, ...]] = {}
        for header, known in using.items():
            for path in reached(header, includers) - {header}:
                found[path] = (*found.get(path, ()), *known)
        return found

    def _imported(self, name: str, program: Program, depth: int) -> Iterator[str]:
        head, dot, rest = name.partition(".")
        if depth and head in program.imports:
            yield program.imports[head] + dot + rest
        for module in program.using:
            yield f"{module}.{name}"
            for other in self._modules.get(module.strip("."), ()) if depth < _DEEPEST else ():
                yield from self._imported(name, self._programs[other], depth + 1)

    @cached_property
    def _modules(self) -> Mapping[str, list[str]]:
        """Files by each end of the path of their module, of which a name is imported whole anywhere."""
        wanted = {one.strip(".") for program in self._programs.values() for one in program.using}
        found: dict[str, list[str]] = {}
        for path, program in self._programs.items():
            pieces = path.removesuffix(".py").removesuffix("/__init__").split("/")
            for place in range(len(pieces)) if program.language == "python" else ():
                module = ".".join(pieces[place:])
                if module in wanted:
                    found.setdefault(module, []).append(path)
        return found
