"""The files of a package as views and rules read them: content, language, manifest."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.intake.file_budget import refused
from roslens.intake.time_budget import OverBudgetError
from roslens.model.source import Language, Package, Role, SourceFile
from roslens.source.rules.profiles import profiles_of
from roslens.source.syntax.facts import FileFacts
from roslens.source.workspace.surroundings import Surroundings
from roslens.store.cache import Cache

MOST_BYTES = 4_000_000
"""Of a file that a rule on packages reads."""


class PackageFiles(msgspec.Struct, frozen=True, dict=True):
    """What a package consists of.

    Attributes:
        package: its manifest, with the place of every fact.
        root: absolute folder of the workspace.
        files: all of the package.
        facts: of those that have a syntax, by path.
        texts: contents by path that count instead of what files hold.
        others: paths of the files that have no language of interest: licences, meshes, ``setup.cfg``.
        around: what other packages of the workspace are to it.
        cache: what earlier runs learned, to be read alone; None for nothing.
    """

    package: Package
    root: str
    files: tuple[SourceFile, ...]
    facts: Mapping[str, FileFacts] = {}
    texts: Mapping[str, bytes] = {}
    others: tuple[str, ...] = ()
    around: Surroundings = Surroundings()
    cache: Cache | None = None

    @cached_property
    def by_path(self) -> Mapping[str, SourceFile]:
        """The files by their path below the workspace."""
        return {file.path: file for file in self.files}

    @property
    def folder(self) -> str:
        """Path of the package below the workspace; empty at its root."""
        return self.package.path.strip("/").removeprefix(".")

    def inside(self, path: str) -> str:
        """Return a path below the workspace as one below the package."""
        return path.removeprefix(f"{self.folder}/") if self.folder else path

    @cached_property
    def listing(self) -> frozenset[str]:
        """Paths of all files below the package."""
        return frozenset(self.inside(path) for path in (*self.by_path, *self.others))

    def exists(self, path: str) -> bool:
        """Return whether a path below the workspace is there, also where no walk went."""
        return self.inside(path) in self.listing or Path(self.root, path).exists()

    def path(self, inside: str) -> str:
        """Return a path below the package as one below the workspace."""
        return f"{self.folder}/{inside}" if self.folder else inside

    @cached_property
    def ros(self) -> frozenset[int]:
        """The versions of ROS that it is built for: 1, 2 or both."""
        return frozenset(int(name[-1]) for name in profiles_of(self.package))

    def of_language(self, *languages: Language, roles: tuple[Role, ...] = (Role.OWN, Role.TEST)) -> list[SourceFile]:
        """Return the files in one of the languages, in order of their paths."""
        return sorted(
            (file for file in self.files if file.language in languages and file.role in roles),
            key=lambda file: file.path,
        )

    def read(self, path: str) -> bytes:
        """Return a file's content; nothing where it cannot be read or is too large.

        Raises:
            OverBudgetError: it takes more than a file may, so that it is left out.
        """
        if why := refused().get(path):
            raise OverBudgetError(why, path)
        if path in self.texts:
            return self.texts[path]
        try:
            return read_bounded(Path(self.root, path), MOST_BYTES)
        except (OSError, ValueError):
            return b""
