"""What source tells of the nodes of a workspace, from its packages to the facts of all units, through the cache.

find packages -> take inventory -> (nothing changed? what is kept is the answer) -> programs of changed files -> index
-> evaluate units; beside them what builds make, and interfaces. Each part is kept under the hash of all it depends on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TypeVar

import msgspec

from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.source import OUTSIDE_PACKAGES, Language, Package, Role, SourceFile
from roslens.source.extract.files import FolderFiles
from roslens.source.extract.launched import Unresolved
from roslens.source.extract.node_facts import Evidence, NodeFacts, Target
from roslens.source.extract.targets import Build, build_of
from roslens.source.extract.workspace_interfaces import INTERFACES, KnownInterface, interfaces_of, ros_generation
from roslens.source.inventory import Inventory, take_inventory
from roslens.source.keys import analyser_version, key_of
from roslens.source.known_manifests import KnownManifests
from roslens.source.progress import Progress, Silent
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import FoundPackage, Workspace, find_workspace
from roslens.store.cache import Cache

_LAUNCH = frozenset({Language.LAUNCH_XML, Language.LAUNCH_PYTHON, Language.LAUNCH_YAML})
_PROGRAMS = frozenset({Language.C, Language.CPP, Language.PYTHON})


class LaunchFile(msgspec.Struct, frozen=True, order=True):
    """A launch file: its path, the id of its package, and for which ROS that package is built, 1 or 2."""

    path: str
    package: str
    generation: int


class Extraction(msgspec.Struct, frozen=True):
    """What the source of a workspace tells of nodes.

    Attributes:
        root: absolute folder that paths start from.
        packages: sorted by path.
        nodes: facts of all units, in order of their files.
        builds: what the build of each package makes, by name; of two packages of one name that of the first.
        interfaces: messages, services and actions, sorted by name.
        launch_files: sorted by path.
        unresolved: what of source and builds could not be evaluated.
        failures: what could not be read at all.
    """

    root: str
    packages: tuple[Package, ...]
    nodes: tuple[NodeFacts, ...]
    builds: dict[str, Build]
    interfaces: tuple[KnownInterface, ...]
    launch_files: tuple[LaunchFile, ...]
    unresolved: tuple[Unresolved, ...] = ()
    failures: tuple[Failure, ...] = ()

    @property
    def targets(self) -> tuple[Target, ...]:
        """What builds make, package by package."""
        return tuple(target for build in self.builds.values() for target in build.targets)


class _Nodes(msgspec.Struct, frozen=True, array_like=True):
    nodes: tuple[NodeFacts, ...]
    unresolved: tuple[Unresolved, ...]
    failures: tuple[Failure, ...]
    lasting: bool = True


class _Builds(msgspec.Struct, frozen=True, array_like=True):
    builds: dict[str, Build]
    failures: tuple[Failure, ...]
    lasting: bool = True


class _Interfaces(msgspec.Struct, frozen=True, array_like=True):
    interfaces: tuple[KnownInterface, ...]
    failures: tuple[Failure, ...]
    lasting: bool = True


def extract(
    paths: Sequence[str | Path],
    settings: SourceSettings,
    *,
    cache: Cache,
    now_s: float,
    jobs: int = 0,
    progress: Progress | None = None,
) -> Extraction:
    """Return what the source below ``paths`` tells of nodes.

    Args:
        paths: folders to look into.
        settings: everything that shapes the result.
        cache: what earlier runs learned of files.
        now_s: the time, in seconds since 1970.
        jobs: worker processes; 0 means one per processor, 1 none.
        progress: who watches.

    Raises:
        UsageError: a path does not exist or is a file.
    """
    watch = progress or Silent()
    watch.step("Looking for packages", 0)
    manifests = KnownManifests(cache)
    workspace = find_workspace(paths, settings.workspace, read=manifests.read)
    manifests.keep()
    known = cache.stats(now_s=now_s)
    inventory = take_inventory(workspace, settings.workspace, known)
    if inventory.learned:
        cache.put_stats(inventory.learned, now_s=now_s)
    return extract_found(workspace, inventory, settings, cache=cache, jobs=jobs, progress=watch)


def extract_found(
    workspace: Workspace,
    inventory: Inventory,
    settings: SourceSettings,
    *,
    cache: Cache,
    jobs: int = 0,
    progress: Progress | None = None,
) -> Extraction:
    """Return what the source of packages tells of nodes; see :func:`extract`.

    Code of tests makes no nodes of the workspace, and names in it would stand beside those of the code that they test.
    """
    work = _Extracting(workspace, inventory, settings, cache, jobs, progress or Silent())
    builds = work.kept("builds", work.builds_key(), _Builds, work.builds)
    interfaces = work.kept("interfaces", work.interfaces_key(), _Interfaces, work.interfaces)
    entries = [target for build in builds.builds.values() for target in build.targets if target.entry]
    nodes = work.kept("nodes", work.nodes_key(entries), _Nodes, lambda: work.nodes(entries))
    return Extraction(
        root=workspace.root,
        packages=work.packages,
        nodes=nodes.nodes,
        builds=builds.builds,
        interfaces=interfaces.interfaces,
        launch_files=tuple(work.launch_files()),
        unresolved=(*nodes.unresolved, *(one for build in builds.builds.values() for one in build.unresolved)),
        failures=(
            *workspace.failures,
            *inventory.failures,
            *builds.failures,
            *interfaces.failures,
            *nodes.failures,
        ),
    )


Part = TypeVar("Part", _Nodes, _Builds, _Interfaces)


class _Extracting:
    def __init__(
        self,
        workspace: Workspace,
        inventory: Inventory,
        settings: SourceSettings,
        cache: Cache,
        jobs: int,
        watch: Progress,
    ) -> None:
        self._found: dict[str, FoundPackage] = {}
        for one in workspace.packages:
            if one.package.id != OUTSIDE_PACKAGES:
                self._found.setdefault(one.package.name, one)
        self._root = workspace.root
        self._workspace = workspace
        self._files: Mapping[str, tuple[SourceFile, ...]] = inventory.files
        self._settings = settings
        self._cache = cache
        self._jobs = jobs
        self._watch = watch
        self.packages = tuple(one.package for one in workspace.packages)

    def kept(self, name: str, key: str, kind: type[Part], make: Callable[[], Part]) -> Part:
        """Return a part of the result from the cache; what is not there is made, and kept if it will last."""
        full = f"graph:{name}:{key}"
        if (packed := self._cache.get((full,)).get(full)) is not None:
            try:
                part = msgspec.msgpack.decode(packed, type=kind)
            except msgspec.DecodeError:
                part = None
            if part is not None:
                self._cache.touch((full,))
                return part
        part = make()
        if part.lasting:
            self._cache.put({full: msgspec.msgpack.encode(part)})
        return part

    def _sources(self) -> Iterable[SourceFile]:
        for files in self._files.values():
            for file in files:
                if file.language in _PROGRAMS and file.role is not Role.TEST:
                    yield file

    def _owners(self) -> dict[str, str]:
        return {file.path: package for package, files in self._files.items() for file in files}

    def nodes_key(self, entries: Iterable[Target]) -> str:
        """Return what the facts of units depend on: all programs, their packages, and which functions are started."""
        files = sorted((file.path, file.content_hash, file.language.value) for file in self._sources())
        started = sorted({(target.entry, target.sources) for target in entries})
        return key_of(analyser_version(), self._settings.macros, files, sorted(self._owners().items()), started)

    def nodes(self, entries: Iterable[Target]) -> _Nodes:
        """Evaluate all units."""
        from roslens.source.extract.isolated_units import units_of
        from roslens.source.extract.workspace_index import Index
        from roslens.source.extract.workspace_programs import not_understood, workspace_programs

        programs = workspace_programs(
            self._root,
            self._sources(),
            self._settings.macros,
            cache=self._cache,
            jobs=self._jobs,
            watch=self._watch,
        )
        self._watch.step("Evaluating nodes", 0)
        owners = self._owners()
        nodes, failures = units_of(Index(programs.programs, owners), entries)
        missed = (
            Unresolved(reason, Evidence(path, line), "this part of the file was not understood")
            for path, line, reason in not_understood(programs.programs)
        )
        placed = tuple(
            msgspec.structs.replace(one, package=owners.get(one.location.path, "") if one.location else "")
            for one in (*programs.failures, *failures)
        )
        return _Nodes(nodes, tuple(missed), placed, programs.lasting)

    def builds_key(self) -> str:
        """Return what builds depend on: which files there are, and the content of those that are no code."""
        known = {file.path: file for files in self._files.values() for file in files}
        parts: list[object] = []
        for found in self._workspace.packages:
            parts.append((found.package.name, found.package.path, found.package.build_type))
            for entry in found.files:
                file = known.get(entry.path)
                if file is None:
                    parts.append((entry.path, entry.size, entry.mtime_ns))
                elif file.language in (Language.C, Language.CPP) or (
                    file.language is Language.PYTHON and not entry.path.endswith("setup.py")
                ):
                    parts.append(entry.path)
                else:
                    parts.append((entry.path, file.content_hash))
        return key_of(analyser_version(), parts)

    def builds(self) -> _Builds:
        """Read what builds make."""
        self._watch.step("Reading builds", len(self._found))
        folders = {name: _folder(one.package) for name, one in self._found.items()}
        files = FolderFiles(Path(self._root), folders)
        builds: dict[str, Build] = {}
        failures: list[Failure] = []
        for name in sorted(self._found):
            found = self._found[name]
            about = found.package
            try:
                builds[name] = build_of(
                    name, folders[name], about.build_type, files, [file.path for file in found.files]
                )
            except Exception as error:  # noqa: BLE001 - one package must not lose the others
                failures.append(_broken_build(about, error))
                builds[name] = Build()
            self._watch.advance(item=name)
        return _Builds(builds, tuple(failures))

    def interfaces_key(self) -> str:
        """Return what interfaces depend on: their files, and for which ROS packages are built."""
        files = [
            (package.id, package.name, ros_generation(package), file.path, file.content_hash)
            for package in self.packages
            for file in self._files.get(package.id, ())
            if file.language in INTERFACES
        ]
        return key_of(analyser_version(), files)

    def interfaces(self) -> _Interfaces:
        """Read the interfaces."""
        found, failures = interfaces_of(self._root, self._files, self.packages)
        return _Interfaces(found, failures, all(one.tool != "read" for one in failures))

    def launch_files(self) -> list[LaunchFile]:
        """Return the launch files."""
        return sorted(
            LaunchFile(file.path, package.id, ros_generation(package))
            for package in self.packages
            for file in self._files.get(package.id, ())
            if file.language in _LAUNCH
        )


def _folder(package: Package) -> str:
    return "" if package.path == "." else package.path


def _broken_build(package: Package, error: Exception) -> Failure:
    import traceback

    return Failure(
        tool="graph",
        what=f"{type(error).__name__}: {error}",
        expected="a build whose targets can be read",
        advice="Please report it with the package: this is a fault of roslens",
        entity=str(EntityId(EntityKind.PACKAGE, package.id)),
        package=package.id,
        partial=True,
        detail="".join(traceback.format_exception(error)),
    )
