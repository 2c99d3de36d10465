"""Programs of a workspace by what they define: classes, functions and constants, and what a name means at a place."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from roslens.source.extract.interfaces.interfaces_by_package import InterfacesByPackage
from roslens.source.extract.ir.assigned_names import assigned_names
from roslens.source.extract.ir.program import (
    Expression,
    Function,
    Program,
)
from roslens.source.extract.ir.type_names import dotted, scopes, type_arguments, type_name
from roslens.source.extract.symbols.definitions import Defined, DefinedFunction, Definitions
from roslens.source.extract.symbols.included_files import Needs, Packages
from roslens.source.extract.symbols.internal_linkage import own_names
from roslens.source.extract.symbols.linkage import Linkage
from roslens.source.extract.symbols.macro_values import MacroValues
from roslens.source.extract.symbols.memo import Memo
from roslens.source.extract.symbols.outside_values import OutsideValues
from roslens.source.extract.symbols.package_contents import PackageContents
from roslens.source.extract.symbols.python_modules import PythonModules
from roslens.source.extract.symbols.used_names import UsedNames

if TYPE_CHECKING:
    from roslens.source.extract.facts.node_facts import Target
    from roslens.source.extract.parameters.parameter_library import ParameterLibrary
    from roslens.source.extract.symbols.evaluated_unit import KnownUnits

__all__ = ["Defined", "DefinedFunction", "SymbolTable", "dotted", "type_arguments", "type_name"]


class SymbolTable:
    """What the programs of a workspace define; the first definition of a name counts.

    Attributes:
        programs: by path.
        interfaces: that packages have, by name.
        contents: what files of packages have in common.
        linkage: which definitions files of C++ can mean.
        parameter_libraries: code that builds generate to declare parameters, which no program holds.
        version: of ROS for which its programs are; empty where all are looked at together.
        units: that were evaluated; None where none is asked for again.
    """

    def __init__(
        self,
        programs: Mapping[str, Program],
        packages: Packages | None = None,
        needs: Needs | None = None,
        targets: Iterable[Target] = (),
        *,
        known: Collection[str] = frozenset(),
    ) -> None:
        """Index programs by path.

        Args:
            programs: of the workspace.
            packages: of each file; by default its first folder.
            needs: what packages depend on.
            targets: that builds make.
            known: whole names of which the meaning is known: they mean that too where their source is in the workspace.
        """
        self.memo = Memo()
        outer = frozenset(known)
        self.programs: Mapping[str, Program] = dict(programs)
        self.version = ""
        self.parameter_libraries: tuple[ParameterLibrary, ...] = ()
        self.units: KnownUnits | None = None
        self.interfaces = InterfacesByPackage(packages or {})
        self.linkage = Linkage(self.programs, packages or {}, needs or {}, targets)
        self._own = own_names(self.programs, packages or {}, needs or {})
        self._ambiguous = {name for names in self._own.values() for name in names}
        self.contents = PackageContents(self.programs, packages or {})
        self._modules = PythonModules(self.programs, outer, self.linkage)
        self._definitions = Definitions(
            self.programs, outer, self._own, self._modules, OutsideValues(self.linkage), self.contents.package_of
        )
        self._used = UsedNames(self.programs, outer, packages or {}, needs or {})
        self._macros = MacroValues(self.programs, self.linkage)
        self._forget()

    def _forget(self) -> None:
        """Remember nothing of what was asked."""
        self._changed: dict[str, frozenset[str]] = {}
        self._chains: dict[str, list[Defined]] = {}
        self._chains_of: dict[int, list[Defined]] = {}
        self._outer_bases: dict[str, list[str]] = {}
        self._found_classes: dict[tuple[str, str, str], Defined | None] = {}
        self._found_functions: dict[tuple[str, str, str], list[DefinedFunction]] = {}
        self._found_aliases: dict[tuple[str, str, str], str] = {}
        self._found_meanings: dict[tuple[str, str, str], str] = {}
        self._last_named: tuple[tuple[str, str, str], tuple[str, ...]] = (("", "", ""), ())
        self._found_constants: dict[tuple[str, str, str], tuple[str, Expression, str] | None] = {}
        self._found_globals: dict[tuple[str, str, str], str] = {}

    def every_program(self) -> Iterable[Program]:
        """Return all programs, for what is asked of all together: what an outline has of each."""
        return self.programs.values()

    def named(self, name: str, path: str, scope: str) -> tuple[str, ...]:
        """Return what a name may mean in a scope of a file, the likeliest first."""
        key = (name, path, scope)
        if key != self._last_named[0]:
            # Who asks what a name means asks for classes, functions and constants, one after the other.
            self._last_named = key, tuple(self._named(name, path, scope))
        return self._last_named[1]

    def _named(self, name: str, path: str, scope: str) -> Iterator[str]:
        program = self.programs.get(path)
        if program is not None and program.language == "python":
            for before in scopes(scope):
                yield f"{path}:{before}{name}"
            yield from self._modules.imported(name, path)
            return
        own = self._own.get(path)
        for one in self._named_in_cpp(name, scope, program):
            if own and (home := own.get(one) or own.get(one.rpartition(".")[0])):
                yield f"{home}:{one}"
            yield one

    def _named_in_cpp(self, name: str, scope: str, program: Program | None) -> Iterator[str]:
        around = scopes(scope)
        for before in around:
            yield before + name
        if program is None:
            return
        head, _, rest = name.partition(".")
        if head in self._definitions.last_aliases:
            yield from self._by_alias(name, around, program)
        second, dot, rest = rest.partition(".")
        for before in around if dot and second in self._definitions.last_aliases else ():
            # A name for a namespace that another namespace has: ``outer::short::Class``.
            meaning = self._definitions.aliases.get(f"{before}{head}.{second}")
            if meaning is not None:
                yield f"{before}{head}.{dotted(meaning)}.{rest}"
                yield f"{dotted(meaning)}.{rest}"
        for using in program.using:
            yield f"{using}.{name}"

    def _by_alias(self, name: str, around: Sequence[str], program: Program) -> Iterator[str]:
        head, dot, rest = name.partition(".")
        for before in around:
            meaning = program.imports.get(before + head) or self._definitions.aliases.get(before + head)
            if meaning is not None:
                yield dotted(meaning) + dot + rest
                if before:
                    yield f"{before}{dotted(meaning)}{dot}{rest}"

    def package(self, path: str) -> str:
        """Return the package that a file belongs to."""
        return self.contents.package_of(path)

    def adapted(self, name: str, path: str, scope: str) -> str:
        """Return the message that a class is registered to stand for; empty where it is not."""
        known = self.contents.adapted
        return next((known[one] for one in self.named(name, path, scope) if one in known), "") if known else ""

    def key(self, defined: Defined) -> str:
        """Return the name by which what a class defines is kept."""
        return self._definitions.key(defined)

    def meaning(self, name: str, path: str, scope: str) -> str:
        """Return a name with its aliases of the file resolved, as far as they go."""
        key = (name, path, scope)
        known = self._found_meanings.get(key)
        if known is None:
            known = self._found_meanings[key] = self._meaning(name, path, scope)
        return known

    def _meaning(self, name: str, path: str, scope: str) -> str:
        whole = self.alias(name, path, scope)
        if whole:
            return dotted(whole)
        head, dot, rest = name.partition(".")
        found = self.alias(head, path, scope)
        if found and dotted(found) != name:
            return dotted(found) + dot + rest
        return self._used.meant(name, path, scopes(scope)) or name

    def alias(self, name: str, path: str, scope: str) -> str:
        """Return what a name without scope is an alias of, as written; empty where it is none."""
        key = (name, path, scope)
        found = self._found_aliases.get(key)
        if found is None:
            found = self._found_aliases[key] = self._alias(name, path, scope)
        return found

    def _alias(self, name: str, path: str, scope: str) -> str:
        program = self.programs.get(path)
        if program is not None and name.rpartition(".")[2] in self._definitions.last_aliases:
            for before in scopes(scope):
                found = program.imports.get(before + name) or self._definitions.aliases.get(before + name)
                if found is not None and dotted(found) != name:
                    return found
            inherited = self._inherited_alias(name, path, scope)
            if inherited:
                return inherited
        # Headers of a package are included by its files, as a rule.
        meanings = self._definitions.header_aliases.get((self.package(path), name), set())
        return next(iter(meanings)) if len(meanings) == 1 else ""

    def _inherited_alias(self, name: str, path: str, scope: str) -> str:
        """Return what a base of the classes around calls by a name."""
        if "." in name or self._is_python(path):
            return ""
        for before in scopes(scope)[:-1]:
            around = self.class_of(before[:-1], path, "")
            for one in self.chain(around)[1:] if around is not None else ():
                found = self._definitions.aliases.get(f"{one.what.qualified_name}.{name}")
                if found is not None:
                    return found
        return ""

    def class_of(self, name: str, path: str, scope: str) -> Defined | None:
        """Return the class that a name means; by its last part alone where that is the only one of its kind."""
        key = (name, path, scope)
        if key not in self._found_classes:
            self._found_classes[key] = self._class_of(name, path, scope)
        return self._found_classes[key]

    def _class_of(self, name: str, path: str, scope: str) -> Defined | None:
        for one in self.named(name, path, scope):
            if one in self._definitions.classes:
                return self._known_of(one, self._definitions.classes[one], path)
        if self._is_python(path):
            return None
        candidates = self._definitions.classes_by_last.get(name.rpartition(".")[2], [])
        if len({one.what.qualified_name for one in candidates}) == 1 and _fits(name, candidates[0]):
            return candidates[0]
        return None

    def _known_of(self, name: str, found: list[Defined], path: str) -> Defined | None:
        """Return the first class of a name; where others have it too, of those that a file may know."""
        if path not in self.programs or (len(found) == 1 and name not in self._ambiguous):
            return found[0]
        return next((one for one in found if self.linkage.may_know(path, one.path)), None)

    def functions_of(self, name: str, path: str, scope: str) -> list[DefinedFunction]:
        """Return the functions that a name means, those of the same file first."""
        key = (name, path, scope)
        if key not in self._found_functions:
            self._found_functions[key] = self._functions_of(name, path, scope)
        return self._found_functions[key]

    def _functions_of(self, name: str, path: str, scope: str) -> list[DefinedFunction]:
        for one in self.named(name, path, scope):
            if one in self._definitions.functions:
                return sorted(self._definitions.functions[one], key=lambda found: found.path != path)
        if self._is_python(path):
            return []
        candidates = self._definitions.functions_by_last.get(name.rpartition(".")[2], [])
        fit = [one for one in candidates if _fits(name, one)]
        return fit if len({one.what.qualified_name for one in fit}) == 1 else []

    def _is_python(self, path: str) -> bool:
        program = self.programs.get(path)
        return program is not None and program.language == "python"

    def methods(self, defined: Defined, name: str) -> list[DefinedFunction]:
        """Return the methods of a class by name; several where it is overloaded."""
        return self._definitions.functions.get(f"{self.key(defined)}.{name}", [])

    def methods_of(self, defined: Defined) -> list[DefinedFunction]:
        """Return all methods of a class, in whatever file."""
        return self._definitions.methods.get(self.key(defined), [])

    def changed(self, defined: Defined) -> frozenset[str]:
        """Return the members that methods of a class other than its constructors assign."""
        key = self.key(defined)
        if key not in self._changed:
            self._changed[key] = self._changed_in(defined)
        return self._changed[key]

    def _changed_in(self, defined: Defined) -> frozenset[str]:
        found: set[str] = set()
        for one in self.chain(defined):
            for method in self.methods_of(one):
                if method.what.name not in (one.what.name, "__init__"):
                    found |= assigned_names(method.what.body)
        return frozenset(found)

    def member(self, defined: Defined, name: str) -> tuple[str, Expression] | None:
        """Return the file and value of a constant of a class."""
        return self._definitions.outside.first(f"{self.key(defined)}.{name}")

    def constant(self, name: str, path: str, scope: str) -> tuple[str, Expression, str] | None:
        """Return the file, the value and the whole name of a constant outside of functions."""
        key = (name, path, scope)
        if key not in self._found_constants:
            self._found_constants[key] = self._constant(name, path, scope)
        return self._found_constants[key]

    def _constant(self, name: str, path: str, scope: str) -> tuple[str, Expression, str] | None:
        # Names of modules of Python have their file in them.
        outside = self._definitions.outside
        everywhere = self._is_python(path) or path not in self.programs
        for one in self.named(name, path, scope):
            found = outside.first(one) if everywhere else outside.constant(one, path)
            if found is not None:
                return (*found, one.rpartition(":")[2])
        value = self._macros.value(name, path)
        return None if value is None else (path, value, name)

    def global_name(self, name: str, path: str, scope: str) -> str:
        """Return the whole name of a variable of C++ outside of functions; empty where it is none."""
        if self._is_python(path):
            return ""
        key = (name, path, scope)
        found = self._found_globals.get(key)
        if found is None:
            found = next((one for one in self.named(name, path, scope) if one in self._definitions.globals), "")
            self._found_globals[key] = found
        return found

    def declaration(self, function: Function, path: str = "") -> Function | None:
        """Return how a function of a file is declared elsewhere, with the defaults of its parameters."""
        return self._definitions.outside.declaration(function, path)

    def chain(self, defined: Defined) -> list[Defined]:
        """Return a class and its bases in the workspace, nearest first, each once."""
        known = self._chains_of.get(id(defined.what))
        if known is None:
            known = self._chains_of[id(defined.what)] = self._chain(defined)
        return known

    def _chain(self, defined: Defined) -> list[Defined]:
        first = self.key(defined)
        if first in self._chains:
            return self._chains[first]
        found: list[Defined] = []
        keys: set[str] = set()
        waiting = [defined]
        while waiting and len(found) < 50:
            one = waiting.pop(0)
            if self.key(one) in keys:
                continue
            found.append(one)
            keys.add(self.key(one))
            waiting += [base for name in one.what.bases if (base := self.class_of(name, one.path, _around(one)))]
        self._chains[first] = found
        return found

    def outer_bases(self, defined: Defined) -> list[str]:
        """Return the bases of a class and of its bases that are not in the workspace, aliases resolved."""
        key = self.key(defined)
        if key not in self._outer_bases:
            self._outer_bases[key] = self._outer_bases_of(defined)
        return self._outer_bases[key]

    def _outer_bases_of(self, defined: Defined) -> list[str]:
        return [
            self.meaning(name, one.path, _around(one))
            for one in self.chain(defined)
            for name in one.what.bases
            if self.class_of(name, one.path, _around(one)) is None
        ]


def _around(defined: Defined | DefinedFunction) -> str:
    return defined.what.qualified_name.rpartition(".")[0]


def _fits(name: str, defined: Defined | DefinedFunction) -> bool:
    """Whether a qualified name may mean this: a scope that is written has to be the end of its scope."""
    scope = name.rpartition(".")[0]
    around = _around(defined)
    return not scope or around == scope or around.endswith(f".{scope}")
