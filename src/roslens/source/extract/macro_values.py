"""Values of macros of C++: of several headers that define one differently, the one that a file includes."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from roslens.source.extract.included_files import Needs, Packages, including, reached
from roslens.source.extract.program import Expression, Program


class MacroValues:
    """The macros of a workspace that stand for a value."""

    def __init__(self, programs: Mapping[str, Program], packages: Packages, needs: Needs) -> None:
        """Collect them."""
        self._programs = programs
        self._packages = packages
        self._needs = needs
        self._defined: dict[str, list[str]] = {}
        for path, program in programs.items():
            for name in program.macros:
                self._defined.setdefault(name, []).append(path)

    def value(self, name: str, path: str) -> Expression | None:
        """Return what a macro stands for in a file; None where it is none, or several things."""
        program = self._programs.get(path)
        if program is not None and name in program.macros:
            return program.macros[name]
        homes = self._defined.get(name, ()) if name.isupper() else ()
        values = [self._programs[one].macros[name] for one in homes]
        if len(set(values)) > 1:
            values = [self._programs[one].macros[name] for one in homes if path in reached(one, self._includers)]
        return values[0] if values and len(set(values)) == 1 else None

    @cached_property
    def _includers(self) -> dict[str, set[str]]:
        return including(self._programs, self._packages, self._needs)
