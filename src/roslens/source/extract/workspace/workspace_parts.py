"""What a workspace is read as for a graph: programs, builds, interfaces and launch files, each through the cache.

Each part is kept under the hash of all that it depends on, and made when it is asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import Protocol, TypeVar, cast

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import OUTSIDE_PACKAGES, Language, Package, SourceFile
from roslens.source.extract.builds.targets import Build
from roslens.source.extract.facts.files import FolderFiles, joined
from roslens.source.extract.facts.node_facts import Target
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.ir.program import Program
from roslens.source.extract.ir.program_codec import becomes_nodes, plain, program_keys, squeezed
from roslens.source.extract.ir.ros_switch import VERSIONS
from roslens.source.extract.parameters.parameter_library import ParameterLibrary, parameter_library
from roslens.source.extract.symbols.symbol_table import SymbolTable
from roslens.source.extract.workspace.file_versions import file_versions
from roslens.source.extract.workspace.known_units import KnownUnits
from roslens.source.extract.workspace.package_versions import versions_of
from roslens.source.extract.workspace.program_outline import Readable, known_outlines
from roslens.source.extract.workspace.workspace_builds import Builds, known_builds
from roslens.source.extract.workspace.workspace_interfaces import (
    INTERFACES,
    KnownInterface,
    interfaces_of,
    ros_generation,
)
from roslens.source.extract.workspace.workspace_programs import WorkspacePrograms, workspace_programs
from roslens.source.inventory import Inventory
from roslens.source.keys import analyser_version, key_of
from roslens.source.progress import Progress, Silent
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import FoundPackage, Workspace
from roslens.store.cache import Cache

_LAUNCH = frozenset({Language.LAUNCH_XML, Language.LAUNCH_PYTHON, Language.LAUNCH_YAML})
_UNREAD = frozenset({Language.C, Language.CPP, Language.PYTHON})
"""Files that builds name but do not read, but for ``setup.py``."""
_NOTHING = Build()


class LaunchFile(msgspec.Struct, frozen=True, order=True):
    """A launch file: its path, the id of its package, and for which ROS that package is built, 1 or 2."""

    path: str
    package: str
    generation: int


class Interfaces(msgspec.Struct, frozen=True, array_like=True):
    """Interfaces, sorted by name, and what of them could not be read or understood."""

    interfaces: tuple[KnownInterface, ...]
    failures: tuple[Failure, ...]
    lasting: bool = True


class _FileVersions(msgspec.Struct, frozen=True, array_like=True):
    versions: dict[str, str]
    lasting: bool = True


class Lasting(Protocol):
    """A part of the result; ``lasting`` is whether the next run would find the same."""

    @property
    def lasting(self) -> bool:
        """Whether it is kept."""


Part = TypeVar("Part", bound=Lasting)


class WorkspaceParts:
    """The parts of a workspace.

    Attributes:
        root: absolute folder that paths start from.
        packages: sorted by path.
        found: packages by name; of two of one name the first, none for files outside of packages.
        same: packages by name; of two of one name both where they are for different versions of ROS.
        files: those that have a language, of each package by its id.
        cached: what earlier runs learned.
    """

    def __init__(
        self,
        workspace: Workspace,
        inventory: Inventory,
        settings: SourceSettings,
        *,
        cache: Cache,
        jobs: int = 0,
        progress: Progress | None = None,
    ) -> None:
        """Look at packages; nothing is read yet."""
        self.root = workspace.root
        self.packages: tuple[Package, ...] = tuple(one.package for one in workspace.packages)
        self.found: dict[str, FoundPackage] = {}
        self.same: dict[str, list[FoundPackage]] = {}
        self.files = inventory.files
        self.cached = cache
        self.watch = progress or Silent()
        self._all = workspace.packages
        self._macros = settings.macros
        self._jobs = jobs
        self._indexes: dict[str, SymbolTable] = {}
        self._known_units: dict[str, KnownUnits] = {}
        self._made: dict[str, Lasting] = {}
        for one in workspace.packages:
            if one.package.id != OUTSIDE_PACKAGES:
                self.found.setdefault(one.package.name, one)
        self.versions = {one.package.id: self._versions_of(one) for one in workspace.packages}
        for one in workspace.packages:
            if one.package.id != OUTSIDE_PACKAGES:
                same = self.same.setdefault(one.package.name, [])
                taken = {version for other in same for version in self.versions[other.package.id]}
                if not taken.intersection(self.versions[one.package.id]):
                    same.append(one)

    def _versions_of(self, found: FoundPackage) -> tuple[str, ...]:
        if found.package.id == OUTSIDE_PACKAGES:
            return ()
        folder = "" if found.package.path == "." else found.package.path
        content = self.reading.content(joined(folder, "CMakeLists.txt"))
        return versions_of(found.package, content or b"", (file.path for file in found.files))

    def kept(self, name: str, key: str, kind: type[Part], make: Callable[[], Part]) -> Part:
        """Return a part from the cache; what is not there is made, and kept if it will last."""
        full = f"graph:{name}:{key}"
        if full not in self._made:
            self._made[full] = self._looked_up(full, kind, make)
        # The name, which is a part of the key, tells of what kind it is.
        return cast("Part", self._made[full])

    def _looked_up(self, full: str, kind: type[Part], make: Callable[[], Part]) -> Part:
        if (packed := self.cached.get((full,)).get(full)) is not None:
            try:
                part = msgspec.msgpack.decode(plain(packed), type=kind)
            except msgspec.DecodeError:
                pass  # What a damaged cache holds is made again.
            else:
                self.cached.touch((full,))
                return part
        part = make()
        if part.lasting:
            # Conditions of one place stand in the facts of all that is made there.
            self.cached.put({full: squeezed(msgspec.msgpack.encode(part))})
        return part

    @property
    def is_lasting(self) -> bool:
        """Whether the next run would find the same parts, as far as they were made."""
        read = self.__dict__.get("programs")
        return all(one.lasting for one in self._made.values()) and (read is None or self.programs.lasting)

    @property
    def folders(self) -> dict[str, str]:
        """Folders of packages by name, below the root; empty of the root itself."""
        return {name: "" if one.package.path == "." else one.package.path for name, one in self.found.items()}

    @cached_property
    def reading(self) -> FolderFiles:
        """The files of the workspace, for what reads them by path."""
        return FolderFiles(Path(self.root), self.folders)

    @cached_property
    def owners(self) -> dict[str, str]:
        """The id of the package of each file."""
        return {file.path: package for package, files in self.files.items() for file in files}

    @cached_property
    def needs(self) -> dict[str, list[str]]:
        """The ids of the packages of the workspace that each package depends on."""
        ids = {name: one.package.id for name, one in self.found.items()}
        return {
            one.package.id: sorted({ids[need.name] for need in one.package.dependencies if need.name in ids})
            for one in self.found.values()
        }

    def sources(self) -> Iterator[SourceFile]:
        """Yield the files whose code may become nodes."""
        for files in self.files.values():
            yield from filter(becomes_nodes, files)

    @cached_property
    def programs_key(self) -> str:
        """A key of what the facts of units depend on: programs and their packages."""
        files = sorted((file.path, file.content_hash, file.language.value) for file in self.sources())
        owners = sorted(self.owners.items())
        parts = sorted({(one.package, one.name, one.kind.value, one.sources, one.versions) for one in self.targets})
        versions = sorted(self.versions.items())
        return key_of(analyser_version(), self._macros, files, owners, self.libraries, self.needs, parts, versions)

    @property
    def targets(self) -> list[Target]:
        """What the builds of all packages make."""
        return [target for build in self.builds.builds.values() for target in build.targets]

    @cached_property
    def programs(self) -> WorkspacePrograms:
        """The programs of the workspace."""
        return workspace_programs(
            self.root, self.sources(), self._macros, cache=self.cached, jobs=self._jobs, watch=self.watch
        )

    @cached_property
    def file_versions(self) -> dict[str, str]:
        """The version of ROS of each file, where a workspace has code for both; nothing where it has not."""
        folders = {one.package.id: one.package.path for one in self._all}
        key = key_of(self.programs_key, sorted(folders.items()))

        def made() -> _FileVersions:
            programs = self.programs
            found = file_versions(
                programs.programs, self.owners, self.needs, self.versions, folders, self.targets
            )  # fmt: skip
            return _FileVersions(found, programs.lasting)

        return self.kept("versions", key, _FileVersions, made).versions

    def code_versions(self) -> tuple[str, ...]:
        """Return the versions of ROS that are looked at by themselves: both, or an empty text where there is one."""
        return VERSIONS if self.file_versions else ("",)

    def index(self, version: str = "") -> SymbolTable:
        """Return what the programs of the workspace define; of one that has code for both, those for a version."""
        version = version if self.file_versions else ""
        if version not in self._indexes:
            targets = [one for one in self.targets if not version or version in (one.versions or VERSIONS)]
            index = indexed(self._programs_for(version), self.owners, self.needs, targets)
            index.parameter_libraries = self.libraries
            index.version = version
            index.units = self.units(version)
            self._indexes[version] = index
        return self._indexes[version]

    def _programs_for(self, version: str) -> dict[str, Program]:
        """Return the programs of a workspace; of one that has code for both versions of ROS, those for one of them."""
        programs = self.programs.programs
        if not version:
            return programs
        known = self.file_versions
        return {
            path: one.variants.get(version, one)
            for path, one in programs.items()
            if known.get(path, version) == version
        }

    def units(self, version: str = "") -> KnownUnits:
        """Return the units that were evaluated before and are still the same."""
        version = version if self.file_versions else ""
        if version not in self._known_units:
            outlines = known_outlines(
                self._program_keys(version), version, self.cached, lambda: self._read_for(version)
            )
            # A file that could not be read has no program; that it is missing is a part of the key.
            contents = {path: one.content for path, one in outlines.items()}
            key = self._names_key({path: one.outline for path, one in outlines.items()})
            self._known_units[version] = KnownUnits(self.cached, key, contents, version)
        return self._known_units[version]

    def _program_keys(self, version: str) -> dict[str, str]:
        known = self.file_versions if version else {}
        keys = program_keys(self.sources(), self._macros)
        return {path: key for path, key in keys.items() if known.get(path, version) == version}

    def _read_for(self, version: str) -> Readable:
        contents = self.programs.contents
        found = {path: (contents[path], one) for path, one in self._programs_for(version).items()}
        return Readable(found, self.programs.lasting)

    def _names_key(self, outlines: Mapping[str, str]) -> str:
        """Return a key of what a symbol table knows of all files together, besides the content of what it hands out."""
        owners = [
            (path, owner)
            for path, owner in sorted(self.owners.items())
            if path in outlines or path.endswith((".msg", ".srv", ".action"))
        ]
        targets = sorted({(one.package, one.name, one.kind.value, one.sources, one.versions) for one in self.targets})
        needs, versions = sorted(self.needs.items()), sorted(self.versions.items())
        return key_of(sorted(outlines.items()), owners, needs, targets, self.libraries, versions)

    def keep(self) -> None:
        """Keep what was learned of units."""
        for one in self._known_units.values():
            one.keep()

    @cached_property
    def libraries(self) -> tuple[ParameterLibrary, ...]:
        """The parameters that builds generate code to declare."""
        made = ((name, one) for name in sorted(self.found) for one in self.builds.builds.get(name, _NOTHING).parameters)
        return tuple(
            parameter_library(
                one.target, self.found[name].package.id, one.path, self.reading.content(one.path), python=one.python
            )
            for name, one in made
        )

    @cached_property
    def builds(self) -> Builds:
        """What builds make."""
        return self.kept("builds", self._builds_key(), Builds, self._builds)

    @cached_property
    def interfaces(self) -> Interfaces:
        """The interfaces of packages."""
        return self.kept("interfaces", self._interfaces_key(), Interfaces, self._interfaces)

    def launch_files(self) -> tuple[LaunchFile, ...]:
        """Return the launch files, sorted by path."""
        found = (
            LaunchFile(file.path, package.id, ros_generation(package))
            for package in self.packages
            for file in self.files.get(package.id, ())
            if file.language in _LAUNCH
        )
        return tuple(sorted(found))

    def _builds_key(self) -> str:
        """Return what builds depend on: which files there are, and the content of those that are no code."""
        known = {file.path: file for files in self.files.values() for file in files}
        parts: list[object] = []
        for found in self._all:
            package = found.package
            parts.append((package.name, package.path, package.build_type, self.versions[package.id]))
            for entry in found.files:
                file = known.get(entry.path)
                if file is None:
                    parts.append((entry.path, entry.size, entry.mtime_ns))
                elif file.language in _UNREAD and not entry.path.endswith("setup.py"):
                    parts.append(entry.path)
                else:
                    parts.append((entry.path, file.content_hash))
        return key_of(analyser_version(), parts)

    def _builds(self) -> Builds:
        return known_builds(self.cached, self.reading, self._all, self.same, self.versions, self.watch)

    def _interfaces_key(self) -> str:
        files = [
            (package.id, package.name, ros_generation(package), file.path, file.content_hash)
            for package in self.packages
            for file in self.files.get(package.id, ())
            if file.language in INTERFACES
        ]
        return key_of(analyser_version(), files)

    def _interfaces(self) -> Interfaces:
        found, failures = interfaces_of(self.root, self.files, self.packages)
        return Interfaces(found, failures, all(one.tool != "read" for one in failures))
