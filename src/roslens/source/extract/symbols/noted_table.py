"""A symbol table that notes which files an evaluation learned something from.

What a table answers depends on what all files define and include, which is their outline (``program_outline.py`` in
``workspace``), and on the content of what it hands out. The second is noted here: an evaluation comes to the same again
as long as all outlines and the files that were noted are the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from roslens.source.extract.ir.program import Expression, Function, Program
from roslens.source.extract.symbols.definitions import Defined, DefinedFunction
from roslens.source.extract.symbols.memo import Memo
from roslens.source.extract.symbols.symbol_table import SymbolTable


class NotedPrograms(Mapping[str, Program]):
    """The programs of a workspace, of which those are noted that are asked for."""

    def __init__(self, every: Mapping[str, Program]) -> None:
        """Begin with none noted."""
        self._every = every
        self.noted: dict[str, Program] = {}

    def __getitem__(self, path: str) -> Program:
        """Return the program of a file."""
        found = self.noted.get(path)
        if found is None:
            found = self.noted[path] = self._every[path]
        return found

    def __contains__(self, path: object) -> bool:
        """Return whether there is one; that is known of all files."""
        return path in self._every

    def __iter__(self) -> Iterator[str]:
        """Yield the paths of all; they are known."""
        return iter(self._every)

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self._every)


class NotedTable(SymbolTable):
    """What a table says in one evaluation; it has its own memory, since what comes from that is not noted."""

    def __init__(self, table: SymbolTable, *paths: str) -> None:
        """Note the files of the unit that is evaluated."""
        self._table = table
        self._noted = NotedPrograms(table.programs)
        self._others = set(paths)
        self.programs = self._noted
        self.memo = Memo(table.memo)
        self.version = table.version
        self.parameter_libraries = table.parameter_libraries
        self.units = table.units
        self.interfaces = table.interfaces
        self.linkage = table.linkage
        self.contents = table.contents
        self._forget()

    @property
    def files(self) -> tuple[str, ...]:
        """The files that something was learned from, sorted."""
        return tuple(sorted(self._others.union(self._noted.noted)))

    def every_program(self) -> Iterable[Program]:
        """Return all programs, for what is asked of all together; none of them is noted."""
        return self._table.every_program()

    def _named(self, name: str, path: str, scope: str) -> Iterator[str]:
        return iter(self._table.named(name, path, scope))

    def key(self, defined: Defined) -> str:
        """Return the name by which what a class defines is kept."""
        return self._table.key(defined)

    def adapted(self, name: str, path: str, scope: str) -> str:
        """Return the message that a class is registered to stand for; empty where it is not."""
        return self._table.adapted(name, path, scope)

    def _meaning(self, name: str, path: str, scope: str) -> str:
        return self._table.meaning(name, path, scope)

    def _alias(self, name: str, path: str, scope: str) -> str:
        return self._table.alias(name, path, scope)

    def _class_of(self, name: str, path: str, scope: str) -> Defined | None:
        found = self._table.class_of(name, path, scope)
        if found is not None:
            self._others.add(found.path)
        return found

    def _functions_of(self, name: str, path: str, scope: str) -> list[DefinedFunction]:
        return self._all_noted(self._table.functions_of(name, path, scope))

    def methods(self, defined: Defined, name: str) -> list[DefinedFunction]:
        """Return the methods of a class by name; several where it is overloaded."""
        return self._all_noted(self._table.methods(defined, name))

    def methods_of(self, defined: Defined) -> list[DefinedFunction]:
        """Return all methods of a class, in whatever file."""
        return self._all_noted(self._table.methods_of(defined))

    def _changed_in(self, defined: Defined) -> frozenset[str]:
        for one in self.chain(defined):
            self.methods_of(one)
        return self._table.changed(defined)

    def member(self, defined: Defined, name: str) -> tuple[str, Expression] | None:
        """Return the file and value of a constant of a class."""
        found = self._table.member(defined, name)
        if found is not None:
            self._others.add(found[0])
        return found

    def _constant(self, name: str, path: str, scope: str) -> tuple[str, Expression, str] | None:
        found = self._table.constant(name, path, scope)
        if found is not None:
            self._others.add(found[0])
        return found

    def global_name(self, name: str, path: str, scope: str) -> str:
        """Return the whole name of a variable of C++ outside of functions; empty where it is none."""
        return self._table.global_name(name, path, scope)

    def declaration(self, function: Function, path: str = "") -> Function | None:
        """Return how a function of a file is declared elsewhere; outlines have declarations whole."""
        return self._table.declaration(function, path)

    def _chain(self, defined: Defined) -> list[Defined]:
        found = self._table.chain(defined)
        self._others.update(one.path for one in found)
        return found

    def _outer_bases_of(self, defined: Defined) -> list[str]:
        return self._table.outer_bases(defined)

    def _all_noted(self, found: list[DefinedFunction]) -> list[DefinedFunction]:
        for one in found:
            self._others.add(one.path)
        return found
