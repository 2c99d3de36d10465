"""Values of macros of C++: of several headers that define one differently, the one that a file includes."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.source.extract.ir.program import Expression, Program
from roslens.source.extract.symbols.linkage import Linkage


class MacroValues:
    """The macros of a workspace that stand for a value."""

    def __init__(self, programs: Mapping[str, Program], linkage: Linkage) -> None:
        """Collect them."""
        self._programs = programs
        self._linkage = linkage
        self._defined: dict[str, list[str]] = {}
        for path, program in programs.items():
            for name in program.macros:
                self._defined.setdefault(name, []).append(path)

    def value(self, name: str, path: str) -> Expression | None:
        """Return what a macro stands for in a file; None where it is none, or several things."""
        program = self._programs.get(path)
        if program is not None and name in program.macros:
            return program.macros[name]
        known = self._defined.get(name, ()) if name.isupper() else ()
        homes = [one for one in known if self._linkage.may_know(path, one)]
        values = [self._programs[one].macros[name] for one in homes]
        if len(set(values)) > 1:
            values = [self._programs[one].macros[name] for one in homes if one in self._linkage.seen(path)]
        return values[0] if values and len(set(values)) == 1 else None
