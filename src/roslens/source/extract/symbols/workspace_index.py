"""Programs of a workspace by what they define: classes, functions and constants, and what a name means at a place."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.interfaces.interfaces_by_package import InterfacesByPackage
from roslens.source.extract.ir.assigned_names import assigned_names
from roslens.source.extract.ir.program import (
    Assign,
    Call,
    Class,
    Evaluate,
    Expression,
    Function,
    Name,
    Program,
)
from roslens.source.extract.ir.type_names import dotted, scopes, type_arguments, type_name
from roslens.source.extract.symbols.included_files import Needs, Packages
from roslens.source.extract.symbols.linkage import Linkage
from roslens.source.extract.symbols.lookups import Lookups
from roslens.source.extract.symbols.macro_values import MacroValues
from roslens.source.extract.symbols.outside_values import OutsideValues
from roslens.source.extract.symbols.own_names import own_names
from roslens.source.extract.symbols.python_modules import PythonModules
from roslens.source.extract.symbols.used_names import UsedNames

if TYPE_CHECKING:
    from roslens.source.extract.facts.node_facts import NodeFacts, Target
    from roslens.source.extract.parameters.parameter_library import ParameterLibrary
    from roslens.source.extract.symbols.reached_functions import Reached

__all__ = ["Defined", "Index", "dotted", "type_arguments", "type_name"]

_CUSTOM = Name("RCLCPP_USING_CUSTOM_TYPE_AS_ROS_MESSAGE_TYPE")


class Defined(msgspec.Struct, frozen=True):
    """A class or function and the file it is in."""

    path: str
    what: Class | Function


class Index:
    """What the programs of a workspace define; the first definition of a name counts.

    Attributes:
        programs: by path.
        interfaces: that packages have, by name.
        linkage: which definitions files of C++ can mean.
        parameter_libraries: code that builds generate to declare parameters, which no program holds.
        version: of ROS for which its programs are; empty where all are looked at together.
        units: what units came to, and the functions that they called; None where none is asked for again.
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
        self.lookups = Lookups()
        self._outer = frozenset(known)
        self.programs = dict(programs)
        self.version = ""
        self.parameter_libraries: tuple[ParameterLibrary, ...] = ()
        self.units: dict[tuple[str, ...], tuple[list[NodeFacts], Reached]] | None = None
        self.interfaces = InterfacesByPackage(packages or {})
        self.linkage = Linkage(self.programs, packages or {}, needs or {}, targets)
        self._own = own_names(self.programs, packages or {}, needs or {})
        self._ambiguous = {name for names in self._own.values() for name in names}
        self._packages = packages or {}
        self._classes: dict[str, list[Defined]] = {}
        self._functions: dict[str, list[Defined]] = {}
        self._classes_by_last: dict[str, list[Defined]] = {}
        self._functions_by_last: dict[str, list[Defined]] = {}
        self._outside = OutsideValues(self.linkage)
        self._methods: dict[str, list[Defined]] = {}
        self._modules = PythonModules(self.programs, self._outer, self.linkage)
        self._used = UsedNames(self.programs, self._outer, packages or {}, needs or {})
        self._aliases: dict[str, str] = {}
        self._header_aliases: dict[tuple[str, str], set[str]] = {}
        self._globals: set[str] = set()
        self._changed: dict[str, frozenset[str]] = {}
        self._chains: dict[str, list[Defined]] = {}
        self._chains_of: dict[int, list[Defined]] = {}
        self._outer_bases: dict[str, list[str]] = {}
        self._found_classes: dict[tuple[str, str, str], Defined | None] = {}
        self._found_functions: dict[tuple[str, str, str], list[Defined]] = {}
        self._generations: dict[str, int] = {}
        self._adapted: dict[str, str] = {}
        self._included: dict[str, set[str]] = {}
        self._found_aliases: dict[tuple[str, str, str], str] = {}
        self._found_meanings: dict[tuple[str, str, str], str] = {}
        self._last_aliases: set[str] = set()
        self._last_named: tuple[tuple[str, str, str], tuple[str, ...]] = (("", "", ""), ())
        # By identity, which is a lot cheaper than by value; what is kept beside it keeps it from being given again.
        self._keys: dict[int, tuple[Class | Function, str]] = {}
        self._found_constants: dict[tuple[str, str, str], tuple[str, Expression, str] | None] = {}
        self._found_globals: dict[tuple[str, str, str], str] = {}
        self._macros = MacroValues(self.programs, self.linkage)
        for path in sorted(self.programs):
            self._add(path, self.programs[path])
        for path in sorted(self.programs):
            self._add_functions(path, self.programs[path])

    def _add(self, path: str, program: Program) -> None:
        # Modules of Python have names of their own; what C++ defines is known by its whole name everywhere.
        before = _before(path, program)
        if before:
            self._modules.add(path)
        self._add_classes(path, program)
        for statement in program.body:
            if not isinstance(statement, Assign) or not isinstance(statement.target, Name):
                continue
            whole = self._before(path, statement.target.name) + statement.target.name
            if not before:
                self._globals.add(whole)
            if statement.value is not None:
                self._outside.add(whole, path, statement.value)
        self._last_aliases.update(alias.rpartition(".")[2] for alias in program.imports)
        for alias, meaning in program.imports.items() if not before else ():
            if "." not in alias and path.endswith((".h", ".hpp", ".hh", ".hxx")):
                self._header_aliases.setdefault((self.package(path), alias), set()).add(meaning)
            if "." in alias:
                # What a class or namespace names otherwise holds in all files that are in it.
                self._aliases.setdefault(alias, meaning)
        self._outside.add_file(path, program)

    @cached_property
    def headers(self) -> frozenset[str]:
        """All that is included anywhere, without brackets."""
        return frozenset(name.strip('<>"') for one in self.programs.values() for name, _line in one.includes)

    def _add_classes(self, path: str, program: Program) -> None:
        for one in program.classes:
            defined = Defined(path, one)
            if one.qualified_name in self._outer:
                continue
            before = self._before(path, one.qualified_name)
            self._classes.setdefault(before + one.qualified_name, []).append(defined)
            if not before:
                self._classes_by_last.setdefault(one.name, []).append(defined)
            for field in one.fields:
                if field.value is not None:
                    self._outside.add(f"{before}{one.qualified_name}.{field.name}", path, field.value)

    def _add_functions(self, path: str, program: Program) -> None:
        for function in program.functions:
            before = self._before(path, function.class_name)
            if function.class_name and not before and function.class_name not in self._classes:
                function = self._of_class_elsewhere(function, program)
            if function.name == "lambda" or not self._outer.isdisjoint((function.qualified_name, function.class_name)):
                continue
            defined = Defined(path, function)
            self._functions.setdefault(before + function.qualified_name, []).append(defined)
            if function.class_name:
                self._methods.setdefault(before + function.class_name, []).append(defined)
            elif not before:
                self._functions_by_last.setdefault(function.name, []).append(defined)

    def _of_class_elsewhere(self, function: Function, program: Program) -> Function:
        """Return a method that is defined outside of its namespace, by a ``using`` of its class or namespace."""
        head, dot, rest = function.class_name.partition(".")
        alias = program.imports.get(head)
        meanings = [dotted(alias) + dot + rest] if alias else []
        for whole in (*meanings, *(f"{using}.{function.class_name}" for using in program.using)):
            if whole in self._classes:
                last = function.qualified_name.removeprefix(function.class_name)
                return msgspec.structs.replace(function, class_name=whole, qualified_name=whole + last)
        return function

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
        head, dot, rest = name.partition(".")
        for before in around if head in self._last_aliases else ():
            meaning = program.imports.get(before + head) or self._aliases.get(before + head)
            if meaning is not None:
                yield dotted(meaning) + dot + rest
                if before:
                    yield f"{before}{dotted(meaning)}{dot}{rest}"
        second, dot, rest = rest.partition(".")
        for before in around if dot and second in self._last_aliases else ():
            # A name for a namespace that another namespace has: ``outer::short::Class``.
            meaning = self._aliases.get(f"{before}{head}.{second}")
            if meaning is not None:
                yield f"{before}{head}.{dotted(meaning)}.{rest}"
                yield f"{dotted(meaning)}.{rest}"
        for using in program.using:
            yield f"{using}.{name}"

    def package(self, path: str) -> str:
        """Return the package that a file belongs to."""
        return self._packages.get(path) or path.partition("/")[0]

    def votes(self, path: str, vote: Callable[[Program], int]) -> int:
        """Return what the files of a package vote for together, those of the workspace where they are undecided."""
        if not self._generations:
            for other, program in self.programs.items():
                vote_ = vote(program)
                for name in (self.package(other), ""):
                    self._generations[name] = self._generations.get(name, 0) + vote_
        return self._generations.get(self.package(path), 0) or self._generations.get("", 0)

    def adapted(self, name: str, path: str, scope: str) -> str:
        """Return the message that a class is registered to stand for; empty where it is not."""
        if not self._adapted:
            self._adapted[""] = ""
            for program in self.programs.values():
                for one in program.body:
                    call = one.expression if isinstance(one, Evaluate) else None
                    if isinstance(call, Call) and call.function == _CUSTOM and len(call.arguments) == 2:
                        custom, message = (getattr(two, "name", "") for two in call.arguments)
                        self._adapted[custom] = message.replace(".", "::")
        if len(self._adapted) == 1:
            return ""
        return next((self._adapted[one] for one in self.named(name, path, scope) if one in self._adapted), "")

    def includes(self, header: str, path: str) -> bool:
        """Return whether any file of the package of a file includes a header."""
        package = self.package(path)
        if package not in self._included:
            self._included[package] = {
                name.strip('<>"')
                for other, program in self.programs.items()
                if self.package(other) == package
                for name, _ in program.includes
            }
        return header in self._included[package]

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
        return f"{home}:" if home else _before(path, self.programs[path])

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
        if program is not None and name.rpartition(".")[2] in self._last_aliases:
            for before in scopes(scope):
                found = program.imports.get(before + name) or self._aliases.get(before + name)
                if found is not None and dotted(found) != name:
                    return found
            inherited = self._inherited_alias(name, path, scope)
            if inherited:
                return inherited
        # Headers of a package are included by its files, as a rule.
        meanings = self._header_aliases.get((self.package(path), name), set())
        return next(iter(meanings)) if len(meanings) == 1 else ""

    def _inherited_alias(self, name: str, path: str, scope: str) -> str:
        """Return what a base of the classes around calls by a name."""
        if "." in name or self._is_python(path):
            return ""
        for before in scopes(scope)[:-1]:
            around = self.class_of(before[:-1], path, "")
            for one in self.chain(around)[1:] if around is not None else ():
                found = self._aliases.get(f"{one.what.qualified_name}.{name}")
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
            if one in self._classes:
                return self._known_of(one, self._classes[one], path)
        if self._is_python(path):
            return None
        candidates = self._classes_by_last.get(name.rpartition(".")[2], [])
        if len({one.what.qualified_name for one in candidates}) == 1 and _fits(name, candidates[0]):
            return candidates[0]
        return None

    def _known_of(self, name: str, found: list[Defined], path: str) -> Defined | None:
        """Return the first class of a name; where others have it too, of those that a file may know."""
        if path not in self.programs or (len(found) == 1 and name not in self._ambiguous):
            return found[0]
        return next((one for one in found if self.linkage.may_know(path, one.path)), None)

    def functions_of(self, name: str, path: str, scope: str) -> list[Defined]:
        """Return the functions that a name means, those of the same file first."""
        key = (name, path, scope)
        if key not in self._found_functions:
            self._found_functions[key] = self._functions_of(name, path, scope)
        return self._found_functions[key]

    def _functions_of(self, name: str, path: str, scope: str) -> list[Defined]:
        for one in self.named(name, path, scope):
            if one in self._functions:
                return sorted(self._functions[one], key=lambda found: found.path != path)
        if self._is_python(path):
            return []
        candidates = self._functions_by_last.get(name.rpartition(".")[2], [])
        fit = [one for one in candidates if _fits(name, one)]
        return fit if len({one.what.qualified_name for one in fit}) == 1 else []

    def _is_python(self, path: str) -> bool:
        program = self.programs.get(path)
        return program is not None and program.language == "python"

    def methods(self, defined: Defined, name: str) -> list[Defined]:
        """Return the methods of a class by name; several where it is overloaded."""
        return self._functions.get(f"{self.key(defined)}.{name}", [])

    def methods_of(self, defined: Defined) -> list[Defined]:
        """Return all methods of a class, in whatever file."""
        return self._methods.get(self.key(defined), [])

    def changed(self, defined: Defined) -> frozenset[str]:
        """Return the members that methods of a class other than its constructors assign."""
        key = self.key(defined)
        if key not in self._changed:
            found: set[str] = set()
            for one in self.chain(defined):
                for method in self.methods_of(one):
                    if isinstance(method.what, Function) and method.what.name not in (one.what.name, "__init__"):
                        found |= assigned_names(method.what.body)
            self._changed[key] = frozenset(found)
        return self._changed[key]

    def member(self, defined: Defined, name: str) -> tuple[str, Expression] | None:
        """Return the file and value of a constant of a class."""
        return self._outside.first(f"{self.key(defined)}.{name}")

    def constant(self, name: str, path: str, scope: str) -> tuple[str, Expression, str] | None:
        """Return the file, the value and the whole name of a constant outside of functions."""
        key = (name, path, scope)
        if key not in self._found_constants:
            self._found_constants[key] = self._constant(name, path, scope)
        return self._found_constants[key]

    def _constant(self, name: str, path: str, scope: str) -> tuple[str, Expression, str] | None:
        # Names of modules of Python have their file in them.
        everywhere = self._is_python(path) or path not in self.programs
        for one in self.named(name, path, scope):
            found = self._outside.first(one) if everywhere else self._outside.constant(one, path)
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
            found = next((one for one in self.named(name, path, scope) if one in self._globals), "")
            self._found_globals[key] = found
        return found

    def declaration(self, function: Function, path: str = "") -> Function | None:
        """Return how a function of a file is declared elsewhere, with the defaults of its parameters."""
        return self._outside.declaration(function, path)

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
            waiting += [base for name in self._bases(one) if (base := self.class_of(name, one.path, _around(one)))]
        self._chains[first] = found
        return found

    def outer_bases(self, defined: Defined) -> list[str]:
        """Return the bases of a class and of its bases that are not in the workspace, aliases resolved."""
        key = self.key(defined)
        if key not in self._outer_bases:
            self._outer_bases[key] = [
                self.meaning(name, one.path, _around(one))
                for one in self.chain(defined)
                for name in self._bases(one)
                if self.class_of(name, one.path, _around(one)) is None
            ]
        return self._outer_bases[key]

    @staticmethod
    def _bases(defined: Defined) -> tuple[str, ...]:
        return defined.what.bases if isinstance(defined.what, Class) else ()


def _before(path: str, program: Program) -> str:
    return f"{path}:" if program.language == "python" else ""


def _around(defined: Defined) -> str:
    return defined.what.qualified_name.rpartition(".")[0]


def _fits(name: str, defined: Defined) -> bool:
    """Whether a qualified name may mean this: a scope that is written has to be the end of its scope."""
    scope = name.rpartition(".")[0]
    around = _around(defined)
    return not scope or around == scope or around.endswith(f".{scope}")
