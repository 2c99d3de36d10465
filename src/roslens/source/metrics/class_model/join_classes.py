"""Every class of a package, put together from all its files."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

import msgspec

from roslens.model.source import Role, SourceFile
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.class_model.class_names import ClassNames
from roslens.source.metrics.class_model.class_use import called_classes, used_classes
from roslens.source.metrics.class_model.inheritance import depths
from roslens.source.metrics.class_model.reexports import Reexports
from roslens.source.syntax.facts import ClassFacts, FileFacts, FunctionFacts

Place = tuple[int, int]
"""Number of a file and number of a class or function in it."""


class JoinedClasses(msgspec.Struct, frozen=True):
    """The classes of a package by place, and the place of the class that each member function belongs to."""

    classes: dict[Place, ClassInPackage]
    owners: dict[Place, Place]


def join_classes(files: Sequence[tuple[SourceFile, FileFacts]]) -> JoinedClasses:
    """Return the classes of the package whose files these are.

    A member function that is written outside its class joins it wherever in the package that is. Who
    uses a class is asked among classes of files of the same role and of the package's own: what tests
    do with a class does not change its values.
    """
    classes: dict[Place, ClassInPackage] = {}
    owners: dict[Place, Place] = {}
    for syntax in sorted({facts.syntax for _, facts in files}):
        of_syntax = _Joining(files, syntax)
        classes.update(of_syntax.classes())
        owners.update(of_syntax.owners)
    return JoinedClasses(classes, owners)


def _module(path: str) -> str:
    return path.removesuffix(".py").removesuffix("/__init__").replace("/", ".")


class _Joining:
    """The classes of one language on their way together."""

    def __init__(self, files: Sequence[tuple[SourceFile, FileFacts]], syntax: str) -> None:
        self._syntax = syntax
        self._files = files
        self._separator = "::" if syntax == "cpp" else "."
        self._facts: dict[Place, ClassFacts] = {}
        self._full_names: dict[Place, str] = {}
        self._by_name: defaultdict[str, list[Place]] = defaultdict(list)
        for file, (_, facts) in enumerate(files):
            for number, one in enumerate(facts.classes if facts.syntax == syntax else ()):
                place = (file, number)
                name = self._full_name(file, one.qualified_name)
                self._facts[place] = one
                self._full_names[place] = name
                self._by_name[name].append(place)
        self._names = ClassNames(self._by_name, self._separator)
        modules = [
            (_module(file.path), file.path, [name for name, _ in facts.includes])
            for file, facts in files
            if facts.syntax == syntax == "python"
        ]
        self._reexports = Reexports(
            {name: includes for name, _, includes in modules},
            (name for name, path, _ in modules if path.endswith("__init__.py")),
        )
        self._bodies: defaultdict[Place, list[FunctionFacts]] = defaultdict(list)
        self.owners: dict[Place, Place] = {}
        self._join_members()

    def _full_name(self, file: int, qualified_name: str) -> str:
        if self._syntax == "cpp":
            return qualified_name
        return f"{_module(self._files[file][0].path)}.{qualified_name}"

    def _join_members(self) -> None:
        for file, (_, facts) in enumerate(self._files):
            if facts.syntax != self._syntax:
                continue
            for number, function in enumerate(facts.functions):
                if not function.class_name:
                    continue
                name = self._names.find(self._full_name(file, function.class_name), "")
                if name is None:
                    continue
                owner = self._nearest(self._by_name[name], file)
                self.owners[file, number] = owner
                self._bodies[owner].append(function)

    def _nearest(self, places: list[Place], file: int) -> Place:
        """Return the definition that a file means where several have the name: its own, else one of its role."""
        if len(places) == 1:
            return places[0]
        role = self._role(file)
        return min(places, key=lambda place: (place[0] != file, self._role(place[0]) is not role, place))

    def _role(self, file: int) -> Role:
        return self._files[file][0].role

    def classes(self) -> dict[Place, ClassInPackage]:
        """Return every class with the information on it from the others."""
        suppliers = {place: self._suppliers(place) for place in self._facts}
        parents = {place: self._parents(place) for place in self._facts}
        clients = self._turned(suppliers)
        children = self._turned(parents)
        depth = self._depths(parents)
        return {
            place: ClassInPackage(
                facts=facts,
                bodies=tuple(self._bodies.get(place, ())),
                suppliers=frozenset(suppliers[place]),
                clients=frozenset(clients.get(place, ())),
                children=frozenset(children.get(place, ())),
                depth=depth[place],
            )
            for place, facts in self._facts.items()
        }

    def _suppliers(self, place: Place) -> set[str]:
        facts = self._facts[place]
        names = {*facts.bases, *facts.types}
        for field in facts.fields:
            names.update(field.types)
        for method in facts.methods:
            names.update(method.types)
        full_name = self._full_names[place]
        for body in self._bodies.get(place, ()):
            names.update(body.types, body.parameter_types)
            names |= called_classes(body.calls, full_name, self._names, self._syntax)
        if self._syntax == "python":
            names = {self._imported(name, place) for name in names}
        return used_classes(names, full_name, self._names, self._syntax) - {full_name}

    def _imported(self, name: str, place: Place) -> str:
        """Return a name, or the full name of the class that it means by what its file imports."""
        if self._names.find(name, self._full_names[place]) is not None:
            return name
        module = _module(self._files[place[0]][0].path)
        return self._reexports.find(name, module, self._names.candidates(name)) or name

    def _parents(self, place: Place) -> set[str]:
        bases = set(self._facts[place].bases)
        if self._syntax == "python":
            bases.discard("object")
        scope = self._full_names[place].rpartition(self._separator)[0]
        found: set[str] = set()
        for base in bases:
            name = base.removeprefix("::")
            name = self._imported(name, place) if self._syntax == "python" else name
            found.add(self._names.find(name, scope if name == base else "") or name)
        return found - {self._full_names[place]}

    def _turned(self, targets: dict[Place, set[str]]) -> dict[Place, set[str]]:
        """Return by class the full names of those that have it among their targets, tests and the like left out."""
        turned: defaultdict[Place, set[str]] = defaultdict(set)
        for place, names in targets.items():
            role = self._role(place[0])
            for name in names:
                for target in self._by_name.get(name, ()):
                    if role in (Role.OWN, self._role(target[0])):
                        turned[target].add(self._full_names[place])
        return turned

    def _depths(self, parents: dict[Place, set[str]]) -> dict[Place, int]:
        above: dict[str, set[str]] = {}
        for name, places in self._by_name.items():
            above[name] = set().union(*(parents[place] for place in places))
        by_name = depths(above)
        return {place: by_name[name] for place, name in self._full_names.items()}
