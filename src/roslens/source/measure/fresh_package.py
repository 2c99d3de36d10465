"""One package measured and judged again because a file of it was saved, at the cost of that file."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import partial
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.result import PackageResult
from roslens.model.set_aside import SetAside
from roslens.model.source import SourceFile
from roslens.plugins.outcome import Outcome
from roslens.source.chosen_models import chosen_models
from roslens.source.commit import last_change_of
from roslens.source.distributions.target import targets_of
from roslens.source.inventory import Inventory, take_inventory
from roslens.source.keys import content_hash
from roslens.source.measure.analyse_package import measure_task
from roslens.source.measure.finish_package import Finisher
from roslens.source.measure.package_task import package_task
from roslens.source.metrics.table import QUANTITIES
from roslens.source.nameable_rules import nameable_rules
from roslens.source.settings import MacroSettings, SourceSettings
from roslens.source.workspace.acceptances import FILE_NAME as ACCEPTED
from roslens.source.workspace.acceptances import acceptances_of, read_acceptances
from roslens.source.workspace.find import FoundPackage, Workspace, find_workspace
from roslens.source.workspace.manifest import read_manifest
from roslens.source.workspace.silence import Silence
from roslens.source.workspace.surroundings import surroundings_of
from roslens.store.cache import Cache


class Fresh(msgspec.Struct, frozen=True):
    """What is known of a file as it is now: findings, those set aside, and what of it could not be analysed.

    ``package`` is the id of its package.
    """

    package: str
    findings: tuple[Finding, ...]
    set_aside: tuple[SetAside, ...] = ()
    failures: tuple[Failure, ...] = ()


class FreshPackages:
    """The packages of a workspace, any of which can be looked at again at once.

    Rules and limits of quality models are held against it; foreign tools, plug-ins, computation graphs and what all
    packages together show are left to a whole run.
    """

    def __init__(self, paths: Collection[str | Path], settings: SourceSettings, base: Path, cache: Cache) -> None:
        """Find the packages below ``paths``.

        Args:
            paths: folders.
            settings: of the run.
            base: folder of the configuration.
            cache: of facts; what is learned of saved files is put into it.

        Raises:
            UsageError: a path does not exist.
            DocumentError: a quality model is wrong.
        """
        self._paths = list(paths)
        self._settings = settings
        self._base = base
        self._cache = cache
        self._models = chosen_models(settings.models, base, QUANTITIES)
        self.find()

    def find(self) -> None:
        """Look for packages and files again: after a file came or went, or a manifest changed."""
        self._workspace: Workspace = find_workspace(self._paths, self._settings.workspace)
        self._inventory: Inventory = take_inventory(self._workspace, self._settings.workspace, {})
        self._found = {found.package.id: found for found in self._workspace.packages}
        self._files = {package: list(files) for package, files in self._inventory.files.items()}
        packages = [one.package for one in self._workspace.packages]
        environment = self._settings.workspace.environment
        root = self._workspace.root
        last_change = partial(last_change_of, root)
        targets = targets_of(Path(root), packages, self._settings.distro, environment, last_change)
        self._around = surroundings_of(packages, self._inventory.files, targets)
        self._owner = {file.path: package for package, files in self._files.items() for file in files}
        accepted, _ = read_acceptances(self._base / ACCEPTED)
        self._silence = Silence(self._settings.ignore, acceptances_of(accepted, self._inventory.files))

    @property
    def root(self) -> Path:
        """Folder of the workspace."""
        return Path(self._workspace.root)

    @property
    def packages(self) -> Collection[str]:
        """Ids of the packages that are looked at."""
        return self._files.keys()

    def paths_of(self, package: str) -> tuple[str, ...]:
        """Return the paths of the files of a package, by its id."""
        return tuple(file.path for file in self._files[package])

    @property
    def files(self) -> Collection[str]:
        """Paths of all files that are looked at, below the root."""
        return self._owner.keys()

    @property
    def by_path(self) -> Mapping[str, SourceFile]:
        """All files that are looked at, by path."""
        return {file.path: file for files in self._files.values() for file in files}

    @property
    def macros(self) -> MacroSettings:
        """What is blanked before a parse."""
        return self._settings.macros

    def look(self, path: str) -> Fresh | None:
        """Return what is known of a file as it is on the disk now; None where it is no file of the workspace.

        Raises:
            OSError: it cannot be read.
        """
        package = self._owner.get(path)
        if package is None:
            return None
        content = read_bounded(self.root / path)
        files = self._files[package]
        place = next(number for number, file in enumerate(files) if file.path == path)
        files[place] = msgspec.structs.replace(files[place], size=len(content), content_hash=content_hash(content))
        return self._judged(self._found[package], tuple(files), path)

    def judged(self, package: str, texts: Mapping[str, bytes]) -> PackageResult:
        """Return what is known of a package whose files have these contents, by path, instead of those on the disk.

        Raises:
            KeyError: there is no such package.
        """
        files = tuple(
            msgspec.structs.replace(file, size=len(text), content_hash=content_hash(text))
            if (text := texts.get(file.path)) is not None
            else file
            for file in self._files[package]
        )
        return self._result(self._with_manifest(self._found[package], texts), files, texts)

    def _with_manifest(self, found: FoundPackage, texts: Mapping[str, bytes]) -> FoundPackage:
        before = found.package
        text = texts.get(before.manifest.path)
        if text is None:
            return found
        package, _ = read_manifest(text, before.manifest.path, self._settings.workspace.environment)
        if package is None:
            return found
        named = msgspec.structs.replace(package, id=before.id, repository=before.repository)
        return msgspec.structs.replace(found, package=named)

    def _result(self, found: FoundPackage, files: tuple[SourceFile, ...], texts: Mapping[str, bytes]) -> PackageResult:
        package = found.package.id
        kept = str(self._cache.path) if self._cache.path else ""
        others = self._inventory.others.get(package, ())
        task = package_task(
            found,
            files,
            others,
            root=self._workspace.root,
            settings=self._settings,
            kept=kept,
            texts=texts,
            around=self._around.get(package),
        )
        measured = measure_task(task)
        self._cache.put(measured.analyses)
        finisher = Finisher(
            self._settings,
            self._models,
            {package: found.package},
            {package: files},
            (),
            self._silence,
            nameable_rules(self._settings, self._models, ()),
        )
        return finisher.finish(measured, Outcome())

    def _judged(self, found: FoundPackage, files: tuple[SourceFile, ...], path: str) -> Fresh:
        package = found.package.id
        result = self._result(found, files, {})
        return Fresh(
            package,
            tuple(one for one in result.findings if one.path == path),
            tuple(one for one in result.set_aside if one.finding.path == path),
            tuple(
                one
                for one in (*self._workspace.failures, *result.failures)
                if one.location is not None and one.location.path == path
            ),
        )
