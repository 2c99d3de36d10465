"""What evidence is looked for in: texts and settings of a package and of the repository around it."""

from __future__ import annotations

import os
import re
from functools import cached_property
from pathlib import Path

from roslens.intake.bounded_file import read_bounded
from roslens.intake.is_there import is_file, is_folder
from roslens.model.entity import Entity
from roslens.model.result import PackageResult
from roslens.model.source import Language, Location, Role, SourceFile

_MOST_BYTES = 1_000_000
_WORKFLOWS = (".github/workflows", ".gitea/workflows", ".forgejo/workflows", ".circleci")
_PIPELINES = (".gitlab-ci.yml", ".travis.yml", "azure-pipelines.yml", "Jenkinsfile", "appveyor.yml")


class PackageFolder:
    """A package as it lies in its repository; paths of places are below the workspace root."""

    def __init__(self, result: PackageResult, root: Path) -> None:
        """Look at a package of a run.

        Args:
            result: of the package.
            root: of the workspace.
        """
        self.result = result
        self.package = result.package
        self.folder = root / result.package.path
        self.repository = root / result.package.repository if result.package.repository else self._around(root)
        self._root = root

    def _around(self, root: Path) -> Path:
        """Return the folder above the package that holds ``.git``, else the package's own."""
        above = (self.folder, *self.folder.parents)
        return next(
            (one for one in above if os.path.lexists(one / ".git")), root if root != self.folder else self.folder
        )

    def location(self, path: Path, line: int = 0) -> Location:
        """Return the place of a file that was found."""
        return Location(os.path.relpath(path, self._root).replace(os.sep, "/"), line)

    def absolute(self, path: str) -> Path:
        """Return where a file lies whose path is below the workspace root."""
        return self._root / path

    def security(self) -> Path | None:
        """Return the repository's word on vulnerabilities where forges look for it."""
        path = self.repository / ".github" / "SECURITY.md"
        return path if is_file(path) else None

    def find(self, *names: str) -> Path | None:
        """Return the first of these files that the package or its repository has, in its own spelling of case."""
        for folder in dict.fromkeys((self.folder, self.repository)):
            try:
                there = {one.name.lower(): one.name for one in folder.iterdir()}
            except OSError:
                continue
            for name in names:
                if (spelt := there.get(name.lower())) and is_file(folder / spelt):
                    return folder / spelt
        return None

    def text(self, path: Path | None) -> str:
        """Return what a file says; nothing where there is none or it cannot be read."""
        if path is None:
            return ""
        try:
            return read_bounded(path, _MOST_BYTES).decode("utf-8", errors="replace")
        except OSError:
            return ""

    @cached_property
    def declaration(self) -> Path | None:
        """The quality declaration."""
        return self.find("QUALITY_DECLARATION.md", "QUALITY_DECLARATION.rst", "QUALITY_DECLARATION")

    @cached_property
    def readme(self) -> Path | None:
        """What introduces the package, or the repository where the package has none."""
        return self.find("README.md", "README.rst", "README.txt", "README")

    @cached_property
    def pipelines(self) -> tuple[Path, ...]:
        """Files that say what is done on changes."""
        found = [self.repository / name for name in _PIPELINES if is_file(self.repository / name)]
        for name in _WORKFLOWS:
            folder = self.repository / name
            if is_folder(folder):
                found += sorted(one for one in folder.iterdir() if one.suffix in (".yml", ".yaml") and is_file(one))
        return tuple(found)

    def says(self, pattern: str, *paths: Path | None) -> Location | None:
        """Return the first line of these texts that a pattern (without regard to case) fits."""
        wanted = re.compile(pattern, re.IGNORECASE)
        for path in paths:
            for number, line in enumerate(self.text(path).splitlines(), 1):
                if path and wanted.search(line):
                    return self.location(path, number)
        return None

    def own(self, *languages: Language) -> list[SourceFile]:
        """Return the package's own files in these languages."""
        return [one for one in self.result.files if one.role is Role.OWN and one.language in languages]

    def tests(self) -> list[SourceFile]:
        """Return the package's files of tests that are code."""
        return [one for one in self.result.files if one.role is Role.TEST and one.language.parsed_as]

    def public_headers(self) -> list[SourceFile]:
        """Return headers below ``include`` that are no detail of the implementation."""
        headers = [one for one in self.own(Language.C, Language.CPP) if "/include/" in f"/{one.path}"]
        return [one for one in headers if not re.search(r"/(detail|impl|internal|experimental)/", one.path)]

    def entities(self) -> tuple[Entity, ...]:
        """Return everything that was measured of the package."""
        return self.result.entities

    def needs(self, *kinds: str) -> list[str]:
        """Return the names of its dependencies of these kinds, all for none."""
        found = {one.name for one in self.package.dependencies if one.active and (not kinds or one.kind in kinds)}
        return sorted(found)
