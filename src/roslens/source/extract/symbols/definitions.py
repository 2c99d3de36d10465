"""What the programs of a workspace define, by whole names: classes, functions, values, and other names of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import msgspec

from roslens.source.extract.ir.program import Class, Function, Program
from roslens.source.extract.ir.type_names import dotted
from roslens.source.extract.symbols.outside_values import OutsideValues
from roslens.source.extract.symbols.python_modules import PythonModules


class Defined(msgspec.Struct, frozen=True):
    """A class and the file it is in."""

    path: str
    what: Class


class DefinedFunction(msgspec.Struct, frozen=True):
    """A function with a body and the file it is in."""

    path: str
    what: Function


class Definitions:
    """The first definition of a name counts.

    Attributes:
        classes: by their names.
        functions: by their names; several where they are overloaded.
        methods: of classes.
        classes_by_last: those of C++, by the last part of their names.
        functions_by_last: those of C++ outside of classes, likewise.
        aliases: what classes and namespaces name otherwise.
        header_aliases: other names that headers of packages give.
        last_aliases: last parts of all other names.
        globals: variables of C++ outside of functions.
        outside: values outside of functions.
    """

    def __init__(
        self,
        programs: Mapping[str, Program],
        outer: frozenset[str],
        own: Mapping[str, Mapping[str, str]],
        modules: PythonModules,
        outside: OutsideValues,
        package: Callable[[str], str],
    ) -> None:
        """Collect what programs define.

        Args:
            programs: by path.
            outer: whole names of which the meaning is known: their definitions are left out.
            own: names that files have for themselves.
            modules: are notified of those of Python.
            outside: is notified of values outside of functions.
            package: says to which package a file belongs.
        """
        self.classes: dict[str, list[Defined]] = {}
        self.functions: dict[str, list[DefinedFunction]] = {}
        self.methods: dict[str, list[DefinedFunction]] = {}
        self.classes_by_last: dict[str, list[Defined]] = {}
        self.functions_by_last: dict[str, list[DefinedFunction]] = {}
        self.aliases: dict[str, str] = {}
        self.header_aliases: dict[tuple[str, str], set[str]] = {}
        self.last_aliases: set[str] = set()
        self.globals: set[str] = set()
        self.outside = outside
        self._programs, self._outer, self._own = programs, outer, own
        self._modules, self._package = modules, package
        # By identity, which is a lot cheaper than by value; what is kept beside it keeps it from being given again.
        self._keys: dict[int, tuple[Class, str]] = {}
        for path in sorted(programs):
            self._add(path, programs[path])
        for path in sorted(programs):
            self._add_functions(path, programs[path])

    def _add(self, path: str, program: Program) -> None:
        # Modules of Python have names of their own; what C++ defines is known by its whole name everywhere.
        before = own_of_module(path, program)
        if before:
            self._modules.add(path)
        self._add_classes(path, program)
        for name, value in program.variables():
            whole = self._before(path, name) + name
            if not before:
                self.globals.add(whole)
            if value is not None:
                self.outside.add(whole, path, value)
        self.last_aliases.update(alias.rpartition(".")[2] for alias in program.imports)
        for alias, meaning in program.imports.items() if not before else ():
            if "." not in alias and path.endswith((".h", ".hpp", ".hh", ".hxx")):
                self.header_aliases.setdefault((self._package(path), alias), set()).add(meaning)
            if "." in alias:
                # What a class or namespace names otherwise holds in all files that are in it.
                self.aliases.setdefault(alias, meaning)
        self.outside.add_file(path, program)

    def _add_classes(self, path: str, program: Program) -> None:
        for one in program.classes:
            defined = Defined(path, one)
            if one.qualified_name in self._outer:
                continue
            before = self._before(path, one.qualified_name)
            self.classes.setdefault(before + one.qualified_name, []).append(defined)
            if not before:
                self.classes_by_last.setdefault(one.name, []).append(defined)
            for field in one.fields:
                if field.value is not None:
                    self.outside.add(f"{before}{one.qualified_name}.{field.name}", path, field.value)

    def _add_functions(self, path: str, program: Program) -> None:
        for function in program.functions:
            before = self._before(path, function.class_name)
            if function.class_name and not before and function.class_name not in self.classes:
                function = self._of_class_elsewhere(function, program)
            if function.name == "lambda" or not self._outer.isdisjoint((function.qualified_name, function.class_name)):
                continue
            defined = DefinedFunction(path, function)
            self.functions.setdefault(before + function.qualified_name, []).append(defined)
            if function.class_name:
                self.methods.setdefault(before + function.class_name, []).append(defined)
            elif not before:
                self.functions_by_last.setdefault(function.name, []).append(defined)

    def _of_class_elsewhere(self, function: Function, program: Program) -> Function:
        """Return a method that is defined outside of its namespace, by a ``using`` of its class or namespace."""
        head, dot, rest = function.class_name.partition(".")
        alias = program.imports.get(head)
        meanings = [dotted(alias) + dot + rest] if alias else []
        for whole in (*meanings, *(f"{using}.{function.class_name}" for using in program.using)):
            if whole in self.classes:
                last = function.qualified_name.removeprefix(function.class_name)
                return msgspec.structs.replace(function, class_name=whole, qualified_name=whole + last)
        return function

    def key(self, defined: Defined) -> str:
        """Return the name by which what a class defines is kept."""
        what = defined.what
        known = self._keys.get(id(what))
        if known is None or known[0] is not what:
            known = self._keys[id(what)] = (what, self._before(defined.path, what.qualified_name) + what.qualified_name)
        return known[1]

    def _before(self, path: str, name: str) -> str:
        """Return what stands before the name of what a file defines for itself."""
        own = self._own.get(path, {})
        home = own.get(name) or own.get(name.rpartition(".")[0])
        return f"{home}:" if home else own_of_module(path, self._programs[path])


def own_of_module(path: str, program: Program) -> str:
    """Return what stands before names of a module of Python; nothing stands before those of C++."""
    return f"{path}:" if program.language == "python" else ""
