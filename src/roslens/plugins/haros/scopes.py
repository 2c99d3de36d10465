"""Files, packages and what is around them, with the attributes that HAROS plug-ins read.

Written after the attributes and ids that HAROS documents for plug-ins; sizes and line counts are read
from the file when a plug-in asks for them.
"""

from __future__ import annotations

import io
import posixpath
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path

from roslens.intake.bounded_file import read_bounded
from roslens.model.source import Package as RosPackage
from roslens.plugins.haros.declared import TO_HAROS
from roslens.plugins.points import FileInput, PackageInput, WorkspaceInput

_ORDER = ("file", "node", "package", "repository", "project")


class Location:
    """A place to report on."""

    def __init__(self, package: Package, file: SourceFile | None = None) -> None:
        """Start with no line; whoever reports fills in the rest."""
        self.package = package
        self.file = file
        self.line: int | None = None
        self.column: int | None = None
        self.function: str | None = None
        self.class_: str | None = None

    @property
    def largest_scope(self) -> Package:
        """The package."""
        return self.package

    @property
    def smallest_scope(self) -> SourceFile | Package:
        """The file, or the package where there is none."""
        return self.file or self.package

    def __str__(self) -> str:
        """Return package, file and line in words."""
        text = f"in {self.package.name}"
        if self.file is None:
            return text
        text += f"/{self.file.full_name}"
        return text if self.line is None else f"{text}:{self.line}"


class Dependencies:
    """What a scope depends on."""

    def __init__(self, packages: set[str] | None = None) -> None:
        """Start with packages only: nothing else is known of source."""
        self.files: set[str] = set()
        self.packages: set[str] = packages or set()
        self.arguments: set[str] = set()
        self.environment: set[str] = set()


class Scope:
    """Something with an id that belongs to a level: file, package, repository, project."""

    scope = ""

    def __init__(self, identity: str, name: str) -> None:
        """Take the id that is unique in a run."""
        self.id = identity
        self.name = name
        self.dependencies = Dependencies()

    def _rank(self, other: object) -> int:
        level = other if isinstance(other, str) else getattr(other, "scope", "")
        return _ORDER.index(self.scope) - _ORDER.index(str(level))

    def __lt__(self, other: object) -> bool:
        return self._rank(other) < 0

    def __le__(self, other: object) -> bool:
        return self._rank(other) <= 0

    def __gt__(self, other: object) -> bool:
        return self._rank(other) > 0

    def __ge__(self, other: object) -> bool:
        return self._rank(other) >= 0

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and self.id == other.id

    def __hash__(self) -> int:
        return hash(self.id)

    def __repr__(self) -> str:
        return self.id

    def bound_to(self, other: object) -> bool:
        """Return whether one belongs to the other."""
        return self == other

    def accepts_scope(self, scope: str) -> bool:
        """Return whether it is of a level."""
        return self.scope == scope


class SourceFile(Scope):
    """A file of a package."""

    scope = "file"

    def __init__(self, given: FileInput, package: Package) -> None:
        """Take a file as roslens knows it."""
        inner = posixpath.relpath(given.absolute, package.path)
        self.directory, name = posixpath.split(inner)
        super().__init__(f"file:{package.name}/{self.directory}/{name}", name)
        self.given = given
        self.full_name = inner
        self.path = given.absolute
        self.dir_path = posixpath.dirname(given.absolute)
        self.package = package
        self.language = TO_HAROS.get(given.language, "unknown")
        self.tree = None

    @property
    def location(self) -> Location:
        """A new location in this file."""
        return Location(self.package, self)

    @cached_property
    def _text_lines(self) -> tuple[int, int]:
        try:
            content = read_bounded(self.path)
        except OSError:
            return 0, 0
        lines = list(io.TextIOWrapper(io.BytesIO(content), encoding="utf-8", errors="replace"))
        return len(lines), sum(1 for line in lines if line.strip())

    @property
    def lines(self) -> int:
        """Physical lines."""
        return self._text_lines[0]

    @property
    def sloc(self) -> int:
        """Lines that are not blank, comments included."""
        return self._text_lines[1]

    @property
    def size(self) -> int:
        """Bytes; 0 when the file is gone."""
        path = Path(self.path)
        return path.stat().st_size if path.is_file() else 0

    @property
    def timestamp(self) -> float:
        """Time of the last change; 0 when the file is gone."""
        path = Path(self.path)
        return path.stat().st_mtime if path.is_file() else 0.0

    def bound_to(self, other: object) -> bool:
        """Return whether it is, or lies in, the other."""
        if isinstance(other, Package):
            return self.package == other
        if isinstance(other, Repository | Project):
            return self.package in other.packages
        return self == other

    def accepts_scope(self, scope: str) -> bool:
        """Return whether data of a level can be about a file."""
        return self >= scope


class Person:
    """An author or a maintainer."""

    def __init__(self, name: str, email: str) -> None:
        """Take both as the manifest has them."""
        self.id = email
        self.name = name or "Unknown"
        self.email = email


class Package(Scope):
    """A ROS package."""

    scope = "package"

    def __init__(self, given: PackageInput, project: Project) -> None:
        """Take a package as roslens knows it, with the files whose language HAROS knows."""
        package = given.package
        super().__init__(f"package:{package.id}", package.name)
        self.given = given
        self.path = given.folder
        self.project = project
        self.repository: Repository | None = None
        self.is_metapackage = package.metapackage
        self.description = package.description
        self.version = package.version or "0.0.0"
        self.authors = {Person(person.name, person.email) for person in package.authors}
        self.maintainers = {Person(person.name, person.email) for person in package.maintainers}
        self.licenses = {license_.name for license_ in package.licenses}
        self.website = _url(package, "website")
        self.vcs_url = _url(package, "repository")
        self.bug_url = _url(package, "bugtracker")
        self.dependencies = Dependencies({dependency.name for dependency in package.dependencies if dependency.active})
        files = (SourceFile(file, self) for file in given.files if file.language in TO_HAROS)
        self.source_files = sorted(files, key=lambda file: file.given.path)
        self.nodes: list[object] = []
        self.topological_tier = -1

    @property
    def location(self) -> Location:
        """A new location in this package."""
        return Location(self)

    @property
    def file_count(self) -> int:
        """Number of files."""
        return len(self.source_files)

    @property
    def size(self) -> int:
        """Bytes of all files."""
        return sum(file.size for file in self.source_files)

    @property
    def lines(self) -> int:
        """Physical lines of all files."""
        return sum(file.lines for file in self.source_files)

    @property
    def sloc(self) -> int:
        """Lines of all files that are not blank."""
        return sum(file.sloc for file in self.source_files)

    def bound_to(self, other: object) -> bool:
        """Return whether one belongs to, or this one depends on, the other."""
        if isinstance(other, SourceFile):
            return other.package == self
        if isinstance(other, Repository):
            return self.repository == other
        if isinstance(other, Project):
            return self.project is other
        return self == other or (isinstance(other, Package) and other.name in self.dependencies.packages)


class Repository(Scope):
    """A repository and its packages."""

    scope = "repository"

    def __init__(self, name: str) -> None:
        """Start without packages."""
        super().__init__(f"repository:{name}", name)
        self.packages: list[Package] = []


class Project(Scope):
    """Everything that is analysed in one run."""

    scope = "project"

    def __init__(self, name: str) -> None:
        """Start without packages."""
        super().__init__(f"project:{name}", name)
        self.packages: list[Package] = []
        self.repositories: list[Repository] = []
        self.configurations: list[object] = []


def project_of(workspace: WorkspaceInput) -> Project:
    """Return the workspace as HAROS plug-ins see it; packages in the order of their names."""
    project = Project("default")
    project.packages = [Package(given, project) for given in workspace.packages]
    project.packages.sort(key=lambda package: package.id)
    repositories: dict[str, Repository] = {}
    for package in project.packages:
        if name := package.given.package.repository:
            package.repository = repositories.setdefault(name, Repository(name))
            package.repository.packages.append(package)
    project.repositories = [repositories[name] for name in sorted(repositories)]
    for tier, packages in enumerate(_tiers(project.packages), 1):
        for package in packages:
            package.topological_tier = tier
    return project


def _tiers(packages: list[Package]) -> Iterator[list[Package]]:
    """Yield packages by tier: those of tier 1 depend on no other package here; cycles have no tier."""
    left = {package.name: package for package in packages}
    while free := [package for package in left.values() if not _waits(package, left)]:
        yield free
        for package in free:
            left.pop(package.name, None)


def _waits(package: Package, left: Mapping[str, Package]) -> bool:
    return any(name in left and name != package.name for name in package.dependencies.packages)


def _url(package: RosPackage, kind: str) -> str | None:
    return next((url.url for url in package.urls if url.kind == kind), None)
