"""The code of a workspace as units from which configurations are assembled; evaluated when it is asked for.

Programs of all packages are read once, since a node may be made of classes of other packages. What is evaluated is only
what a configuration starts. Programs, builds and what units come to are kept in the cache.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import copy
from functools import cached_property

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import Language, Package, Role
from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import NodeFacts, Target, TargetKind
from roslens.source.extract.ir.program import Program
from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.symbols.evaluated_unit import EvaluatedUnit
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.symbols.symbol_table import SymbolTable
from roslens.source.extract.workspace.known_units import KnownUnits
from roslens.source.extract.workspace.workspace_interfaces import KnownInterface, nearest
from roslens.source.extract.workspace.workspace_nodes import (
    WorkspaceMissed,
    all_nodes,
    workspace_missed,
    workspace_nodes,
)
from roslens.source.extract.workspace.workspace_parts import WorkspaceParts
from roslens.source.inventory import Inventory, take_inventory
from roslens.source.keys import analyser_version, key_of
from roslens.source.progress import Progress
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import Workspace
from roslens.store.cache import Cache


class _Reads(msgspec.Struct, frozen=True, array_like=True):
    """Whether a program reads the words of its command line: known without the program when it was asked before."""

    words: bool
    lasting: bool = True


class WorkspaceFacts:
    """The nodes that code of a workspace becomes.

    See :class:`~roslens.source.extract.configuration.assemble_units.Units`.

    Attributes:
        files: that may be read.
        failures: what could not be read.
        broken: units whose evaluation broke; it grows as they are asked for.
    """

    def __init__(
        self,
        workspace: Workspace,
        settings: SourceSettings,
        *,
        cache: Cache,
        now_s: float,
        jobs: int = 0,
        progress: Progress | None = None,
        inventory: Inventory | None = None,
    ) -> None:
        """Look at the packages of a workspace; no program is read yet.

        Args:
            workspace: its packages and files.
            settings: how files are distinguished, and macros.
            cache: what earlier runs learned.
            now_s: the time, in seconds since 1970.
            jobs: worker processes; 0 means one per processor, 1 none.
            progress: who watches.
            inventory: of the workspace, where it is known.
        """
        if inventory is None:
            inventory = take_inventory(workspace, settings.workspace, cache.stats(now_s=now_s))
            if inventory.learned:
                cache.put_stats(inventory.learned, now_s=now_s)
        self._parts = WorkspaceParts(workspace, inventory, settings, cache=cache, jobs=jobs, progress=progress)
        self.files = self._parts.reading
        self.failures = inventory.failures
        self.broken: list[Failure] = []
        self._interfaces: dict[tuple[str, str], list[KnownInterface]] | None = None
        self._facts: dict[tuple[str, ...], EvaluatedUnit] = {}
        self._version = ""
        self._of: dict[str, WorkspaceFacts] = {}

    def keep(self) -> None:
        """Keep what was learned of units for the next run."""
        self._parts.keep()

    @property
    def code_key(self) -> str:
        """A key of the code and the builds of the workspace."""
        return key_of(self._parts.programs_key, self._parts.builds)

    @property
    def is_lasting(self) -> bool:
        """Whether the next run would find the same: all could be read and evaluated."""
        return not self.broken and self._parts.is_lasting

    def program_contents(self) -> dict[str, str]:
        """Return keys of the programs of files by path."""
        versions = self._parts.code_versions()
        return {path: key for one in versions for path, key in self._parts.units(one).contents.items()}

    def of(self, version: str) -> WorkspaceFacts:
        """Return what the workspace is for one version of ROS, ``ros1`` or ``ros2``: no code or target of the other."""
        if version not in self._of:
            self._of[version] = found = copy(self)
            found.limit(version)
        return self._of[version]

    def limit(self, version: str) -> None:
        """Leave out code and targets that are not for a version of ROS."""
        self._version, self._facts = version, {}
        for name in ("_missed", "_plugin_names", "_plugins_key", "_described"):
            self.__dict__.pop(name, None)

    def versions(self, package: str) -> tuple[str, ...]:
        """Return for which versions of ROS a package is built; nothing where the workspace has none of that name."""
        same = self._parts.same.get(package, ())
        known = {version for one in same for version in self._parts.versions[one.package.id]}
        return tuple(sorted(known))

    @property
    def file_versions(self) -> Mapping[str, str]:
        """The version of ROS of each file, where the workspace has code for both."""
        return self._parts.file_versions

    @property
    def packages(self) -> tuple[Package, ...]:
        """The packages of the workspace, sorted by name."""
        return tuple(self._parts.found[name].package for name in sorted(self._parts.found))

    @property
    def unresolved(self) -> tuple[Unresolved, ...]:
        """What of builds could not be evaluated."""
        return tuple(one for build in self._parts.builds.builds.values() for one in build.unresolved)

    def missed(self, package: str) -> tuple[Unresolved, ...]:
        """Return what of the build of a package could not be evaluated."""
        build = self._parts.builds.builds.get(package)
        return () if build is None else build.unresolved_for.get(self._version, build.unresolved)

    def missed_in_code(self, package: str) -> tuple[Unresolved, ...]:
        """Return parts of the code of a package that were not understood, and calls in it of which no endpoint came."""
        names = self.package_names
        return tuple(one for one in self._missed.missed if names.get(one.evidence.path) == package)

    def never_called(self, package: str) -> tuple[Unresolved, ...]:
        """Return the functions of a package that make endpoints and that nothing was seen to call."""
        names = self.package_names
        return tuple(one for one in self._missed.never_called if names.get(one.evidence.path) == package)

    def made(self) -> tuple[NodeFacts, ...]:
        """Return the facts of all units, whether anything starts them or not."""
        return (workspace_nodes(self._parts, self._code) if self._version else all_nodes(self._parts)).nodes

    @cached_property
    def package_names(self) -> dict[str, str]:
        """The name of the package of each file, of those outside of packages ``(outside packages)``."""
        names = {one.id: one.name for one in self._parts.packages}
        return {path: names.get(owner, owner) for path, owner in self._parts.owners.items()}

    @cached_property
    def roles(self) -> dict[str, str]:
        """Whose code a file is, of all files that are not own code."""
        files = (file for files in self._parts.files.values() for file in files)
        return {file.path: file.role.value for file in files if file.role is not Role.OWN}

    @cached_property
    def _missed(self) -> WorkspaceMissed:
        if self._version:
            return workspace_missed(self._parts, self._code)
        every = [workspace_missed(self._parts, version) for version in self._parts.code_versions()]
        return WorkspaceMissed(
            tuple(dict.fromkeys(place for one in every for place in one.missed)),
            tuple(dict.fromkeys(place for one in every for place in one.never_called)),
        )

    @property
    def _code(self) -> str:
        """The version whose code is looked at by itself; empty where all of the workspace is for one."""
        return self._version if self._parts.file_versions else ""

    def paths(self, package: str) -> tuple[str, ...]:
        """Return the files of a package."""
        return tuple(file.path for found in self._parts.same.get(package, ()) for file in found.files)

    def launch_files(self, package: str) -> tuple[str, ...]:
        """Return the launch files of a package."""
        ids = {found.package.id for found in self._parts.same.get(package, ())}
        return tuple(one.path for one in self._parts.launch_files() if one.package in ids)

    def role(self, path: str) -> Role:
        """Return whose code a file is; own where the workspace does not have it."""
        return Role(self.roles.get(path, Role.OWN.value))

    def program_of(self, path: str) -> Program | None:
        """Return the program of a file; None where it makes no nodes of the workspace, or cannot be read."""
        return self._parts.programs.programs.get(path)

    def has(self, package: str) -> bool:
        """Return whether the workspace has a package of that name."""
        return package in self._parts.found

    def targets(self, package: str) -> Sequence[Target]:
        """Return what the build of a package makes."""
        build = self._parts.builds.builds.get(package)
        targets = () if build is None else build.targets
        if not self._version:
            return targets
        return [one for one in targets if not one.versions or self._version in one.versions]

    def program(
        self, path: str, function: str = "", words: Sequence[Text] | None = None, chosen: Chosen | None = None
    ) -> Sequence[NodeFacts]:
        """Return the nodes that a file becomes when it is started, with these words on its command line."""
        if words is None or not self._reads_words(path):
            key = ("program " + path, function, *_words_of(chosen))
            return self._once(key, path, lambda: self._of_program(path, function, None, chosen))
        key = ("program " + path, function, *map(str, words), *_words_of(chosen))
        return self._once(key, path, lambda: self._of_program(path, function, words, chosen))

    def _reads_words(self, path: str) -> bool:
        key = key_of(
            analyser_version(), self._parts.units(self._code).content(path), "reads its words", path, self._code
        )
        return self._parts.kept("unit", key, _Reads, lambda: self._whether_read(path)).words

    def _whether_read(self, path: str) -> _Reads:
        from roslens.source.extract.overlays.language.command_words import reads_words

        found = self._index_for(path).programs.get(path)
        return _Reads(found is not None and reads_words(found), self._parts.programs.lasting)

    def of_class(self, name: str, sources: Sequence[str] = (), chosen: Chosen | None = None) -> Sequence[NodeFacts]:
        """Return the nodes that an object of a class becomes, of several of that name the one in these sources."""
        key = ("class", name, *sources, *_words_of(chosen))
        return self._once(key, "", lambda: self._of_class(name, sources, chosen))

    def outside_bases(self, name: str) -> Sequence[str]:
        """Return the packages that have bases of a class, are named by a manifest and are not in the workspace."""
        index = self._parts.index(self._version)
        classes = (one for path in index.programs for one in index.programs[path].classes if one.qualified_name == name)
        defined = next((index.class_of(one.qualified_name, "", "") for one in classes), None)
        if defined is None:
            return ()
        wanted = {need.name for one in self._parts.packages for need in one.dependencies}
        owners = (base.replace("::", ".").partition(".")[0] for base in index.outer_bases(defined))
        return sorted({one for one in owners if one in wanted and not self.has(one)})

    @cached_property
    def _plugin_names(self) -> dict[str, str]:
        """Return the class of each plug-in that is described under another name."""
        return {one.name: one.entry for one in self._plugin_targets() if one.entry and one.entry != one.name}

    def _plugin_targets(self) -> Iterator[Target]:
        for name in self._parts.builds.builds:
            yield from (one for one in self.targets(name) if one.kind is TargetKind.PLUGIN)

    @cached_property
    def _described(self) -> dict[str, str]:
        """Return the class of each plug-in by the name under which a description has it."""
        return {one.name: (one.entry or one.name).replace("::", ".") for one in self._plugin_targets()}

    def plugins(self) -> frozenset[str]:
        """Return the names under which descriptions have plug-ins of the workspace."""
        return frozenset(self._described)

    def parts(self, name: str) -> Sequence[NodeFacts]:
        """Return what code makes, wherever it runs: by the name of a plug-in, a class, a function or a file."""
        meant = self._described.get(name, name.replace("::", "."))
        return [one for one in self.made() if one.endpoints and (one.unit == meant or one.path == name)]

    def scripts(self, package: str, name: str) -> Sequence[str]:
        """Return the scripts in Python of a package that have a name as their file name, sorted."""
        found = self._parts.same.get(package, ())
        files = (file for one in found for file in self._parts.files.get(one.package.id, ()))
        return sorted(
            one.path for one in files if one.language is Language.PYTHON and one.path.rpartition("/")[2] == name
        )

    def built_for(self, package: str, name: str) -> Sequence[str]:
        """Return for which versions of ROS the build of a package makes what is started by a name."""
        build = self._parts.builds.builds.get(package)
        made = () if build is None else build.targets
        return sorted({version for one in made if name in (one.name, one.entry) for version in one.versions})

    def checksum(self, interface: str, generation: str, path: str) -> str:
        """Return the checksum of an interface for code in a file; of two definitions of one name that of the nearer."""
        if self._interfaces is None:
            self._interfaces = {}
            for one in self._parts.interfaces.interfaces:
                key = (f"ros{one.interface.generation}", one.interface.full_name)
                self._interfaces.setdefault(key, []).append(one)
        known = self._interfaces.get((generation, interface))
        return nearest(known, path).checksum.text if known else ""

    def _index_for(self, path: str) -> SymbolTable:
        return self._parts.index(self._version or self._parts.file_versions.get(path, ""))

    def _once(
        self, what: tuple[str, ...], path: str, make: Callable[[], tuple[NodeFacts, ...]]
    ) -> tuple[NodeFacts, ...]:
        """Return the nodes of what is started; ``path`` is of its program, empty where a class is asked for."""
        units = self._parts.units(self._code)
        found = self._facts.get(what)
        if found is None:
            name = ("started", *what, *(self._plugins_key if "plug-ins" in what else ()))
            known = units.get(name) if self._alone else None
            found = self._facts[what] = self._made_now(path or what[1], name, make, units) if known is None else known
        units.note(found.files)
        return found.facts

    @property
    def _alone(self) -> bool:
        """Whether all code that is looked at is for one version of ROS: only then units are kept."""
        return bool(self._version) or not self._parts.file_versions

    def _made_now(
        self, where: str, name: tuple[str, ...], make: Callable[[], tuple[NodeFacts, ...]], units: KnownUnits
    ) -> EvaluatedUnit:
        from roslens.source.extract.units.isolated_units import attempt

        files = {where} if units.has(where) else set[str]()
        with units.noting(files):
            nodes = tuple(attempt(lambda: list(make()), where, 0, self.broken))
        unit = EvaluatedUnit(nodes, Reached(), tuple(sorted(files)))
        if self._alone and not self.broken:
            units.add(name, unit)
        return unit

    @cached_property
    def _plugins_key(self) -> tuple[str, ...]:
        return (key_of(self._plugin_names),)

    def _of_program(
        self, path: str, function: str, words: Sequence[Text] | None, chosen: Chosen | None
    ) -> tuple[NodeFacts, ...]:
        from roslens.source.extract.units.assemble_program import classes_made, joined_facts
        from roslens.source.extract.units.node_units import NO_NAMES, facts_of_main, facts_of_module, node_classes

        index = self._index_for(path)
        program = index.programs.get(path)
        if program is None:
            return ()
        if program.language == "python":
            return tuple(facts_of_module(index, path, function, words=words))
        names = self._plugin_names if chosen is not None else NO_NAMES
        main = facts_of_main(index, path, words=words, chosen=chosen, plugin_names=names)
        made = list(classes_made(index, path, [one for one, _, _ in node_classes(index)]))
        if len(made) != 1:
            # Which of several nodes is of which class is unknown here; the main function has all of them.
            return tuple(main) or tuple(one for name in made for one in self.of_class(name, (), chosen))
        found = self.of_class(made[0], (), chosen)
        if not found or (len(main) > 1 and main[0].name != found[0].name):
            return tuple(main)
        return (joined_facts(main[0] if main else None, found[0]), *(main[1:] or found[1:]))

    def _of_class(self, name: str, sources: Sequence[str], chosen: Chosen | None) -> tuple[NodeFacts, ...]:
        from roslens.source.extract.units.node_units import NO_NAMES, facts_of_class, node_classes

        index = self._parts.index(self._version)
        found = list(node_classes(index))
        named = [one for one in found if index.key(one[0]) == name]
        if not named:
            same = [one for one in found if one[0].what.qualified_name == name]
            named = same if len(same) == 1 else [one for one in same if one[0].path in sources]
        names = self._plugin_names if chosen is not None else NO_NAMES
        return tuple(fact for one in named for fact in facts_of_class(index, *one, chosen=chosen, plugin_names=names))


def _words_of(chosen: Chosen | None) -> tuple[str, ...]:
    """Return the key of results that depend on which plug-ins are loaded."""
    return () if chosen is None else ("plug-ins", *(str(word) for one in chosen.values for word in one))
