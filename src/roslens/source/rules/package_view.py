"""A package as rules see it: its manifest, its files, what the one parse told of them."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.source import Language, Package, Role, SourceFile
from roslens.source.syntax.facts import FileFacts

if TYPE_CHECKING:
    from roslens.source.extract.builds.python_setup import Setup
    from roslens.source.rules.cmake_view import CmakeView
    from roslens.source.rules.dependency_uses import Use
    from roslens.source.rules.launch_view import LaunchXml
    from roslens.source.rules.manifest_edits import ManifestEdits
    from roslens.source.rules.registered_classes import Registered
    from roslens.source.workspace.mistakes import Mistake

MOST_BYTES = 4_000_000
"""Of a file that a rule on packages reads."""


class PackageView(msgspec.Struct, frozen=True, dict=True):
    """What is known of a package.

    Attributes:
        package: its manifest, with the place of every fact.
        root: absolute folder of the workspace.
        files: all of the package.
        facts: of those that have a syntax, by path.
        texts: contents by path that count instead of what files hold.
        others: paths of the files that have no language of interest: licences, meshes, ``setup.cfg``.
    """

    package: Package
    root: str
    files: tuple[SourceFile, ...]
    facts: Mapping[str, FileFacts] = {}
    texts: Mapping[str, bytes] = {}
    others: tuple[str, ...] = ()

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

    @cached_property
    def setup(self) -> Setup:
        """What setup.py, setup.cfg and pyproject.toml install."""
        from roslens.source.extract.builds.python_setup import Setup
        from roslens.source.extract.builds.python_setup_targets import read_setup
        from roslens.source.extract.facts.files import FolderFiles

        if not {"setup.py", "setup.cfg", "pyproject.toml"} & self.listing:
            return Setup()
        listing = frozenset(self.path(one) for one in self.listing)
        return read_setup(self.folder, FolderFiles(Path(self.root), {}), listing)

    @cached_property
    def setup_call(self) -> ast.Call | None:
        """The call of ``setup`` in setup.py; nothing where it cannot be read."""
        if "setup.py" not in self.listing:
            return None
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                tree = ast.parse(self.read(self.path("setup.py")))
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return None
        calls = (one for one in ast.walk(tree) if isinstance(one, ast.Call))
        return next((one for one in calls if getattr(one.func, "id", getattr(one.func, "attr", "")) == "setup"), None)

    @cached_property
    def uses(self) -> tuple[Use, ...]:
        """Where it uses other packages."""
        from roslens.source.rules.dependency_uses import uses_of

        return uses_of(self)

    @cached_property
    def launch(self) -> tuple[LaunchXml, ...]:
        """The launch files in XML."""
        from roslens.source.rules.launch_view import launch_files

        return launch_files(self)

    @cached_property
    def registered(self) -> tuple[tuple[Registered, ...], bool]:
        """The plug-ins and components that its sources register, and whether these are all."""
        from roslens.source.rules.registered_classes import registered_classes

        return registered_classes(self)

    @cached_property
    def mistakes(self) -> tuple[Mistake, ...]:
        """What the manifest should say otherwise."""
        from roslens.source.workspace.mistakes import mistakes_of

        path = self.package.manifest.path
        return mistakes_of(self.read(path), path) if path else ()

    @cached_property
    def manifest_edits(self) -> ManifestEdits:
        """What can be done about its package.xml."""
        from roslens.source.rules.manifest_edits import ManifestEdits

        path = self.package.manifest.path
        return ManifestEdits(self.read(path) if path else b"", path)

    @cached_property
    def cmake(self) -> CmakeView:
        """The CMake files, parsed."""
        from roslens.source.rules.cmake_view import CmakeView

        return CmakeView(self)

    def exists(self, path: str) -> bool:
        """Return whether a path below the workspace is there, also where no walk went."""
        return self.inside(path) in self.listing or Path(self.root, path).exists()

    def path(self, inside: str) -> str:
        """Return a path below the package as one below the workspace."""
        return f"{self.folder}/{inside}" if self.folder else inside

    @cached_property
    def ros(self) -> frozenset[int]:
        """The versions of ROS that it is built for: 1, 2 or both."""
        from roslens.source.rules.profiles import profiles_of

        return frozenset(int(name[-1]) for name in profiles_of(self.package))

    def of_language(self, *languages: Language, roles: tuple[Role, ...] = (Role.OWN, Role.TEST)) -> list[SourceFile]:
        """Return the files in one of the languages, in order of their paths."""
        return sorted(
            (file for file in self.files if file.language in languages and file.role in roles),
            key=lambda file: file.path,
        )

    def read(self, path: str) -> bytes:
        """Return a file's content; nothing where it cannot be read or is too large."""
        if path in self.texts:
            return self.texts[path]
        try:
            return read_bounded(Path(self.root, path), MOST_BYTES)
        except (OSError, ValueError):
            return b""
