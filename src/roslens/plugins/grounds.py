"""The entities and files that a hook may report on."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from pathlib import Path, PurePosixPath

from roslens.intake.bounded_file import read_bounded
from roslens.model.entity import Entity, EntityId, EntityKind
from roslens.plugins.points import FileInput, PackageInput, WorkspaceInput


class Grounds:
    """What a hook was given: its files, entities and the place that reports default to."""

    def __init__(
        self,
        *,
        root: str,
        folders: tuple[str, ...],
        paths: Iterable[str],
        entities: Iterable[Entity],
        own_ids: Iterable[str],
        default_path: str = "",
        default_entity: str = "",
        package: str = "",
        content: Callable[[str], bytes] | None = None,
    ) -> None:
        """Take what the hook was given; ``own_ids`` are entities besides those in ``entities``."""
        self.root = root
        self.folders = folders
        self.paths = frozenset(paths)
        self.default_path = default_path
        self.default_entity = default_entity
        self.package = package
        self._entities = tuple(entities)
        self._own_ids = tuple(own_ids)
        self._content = content or self._read
        self._lines: tuple[str, tuple[bytes, ...]] = ("", ())

    @cached_property
    def ids(self) -> frozenset[str]:
        """The text forms of all entities that exist here."""
        return frozenset((*self._own_ids, *(entity.id for entity in self._entities)))

    @cached_property
    def _inside(self) -> Mapping[str, tuple[Entity, ...]]:
        found: dict[str, list[Entity]] = {}
        for entity in self._entities:
            if entity.line and entity.kind in (EntityKind.FUNCTION, EntityKind.CLASS):
                found.setdefault(entity.path, []).append(entity)
        return {path: tuple(entities) for path, entities in found.items()}

    def around(self, path: str, line: int) -> tuple[Entity, ...]:
        """Return the classes and functions around a line, innermost first."""
        around = [entity for entity in self._inside.get(path, ()) if entity.line <= line <= entity.end_line]
        return tuple(sorted(around, key=lambda entity: (entity.end_line - entity.line, -entity.line, entity.id)))

    def entities_of(self, path: str) -> tuple[Entity, ...]:
        """Return the classes and functions of a file."""
        return self._inside.get(path, ())

    def resolve(self, path: str) -> str | None:
        """Return the path below the workspace root of a file given in any of the three ways, else None."""
        if path in self.paths:
            return path
        if path.startswith("/"):
            return self._below_root(path)
        for folder in self.folders:
            inside = os.path.normpath(os.path.join(folder, path))  # noqa: PTH118 - pathlib does not fold `..`
            if (found := self._below_root(inside)) is not None:
                return found
        plain = PurePosixPath(os.path.normpath(path)).as_posix()
        return plain if plain in self.paths else None

    def _below_root(self, path: str) -> str | None:
        for candidate, root in ((path, self.root), (os.path.realpath(path), os.path.realpath(self.root))):
            relative = os.path.relpath(candidate, root).replace(os.sep, "/")
            if relative in self.paths:
                return relative
        return None

    def line_text(self, path: str, line: int) -> str | None:
        """Return the text of a line, None when the file has no such line."""
        if self._lines[0] != path:
            self._lines = (path, tuple(self._content(path).split(b"\n")))
        lines = self._lines[1]
        return lines[line - 1].decode("utf-8", "backslashreplace").strip() if line <= len(lines) else None

    def _read(self, path: str) -> bytes:
        try:
            return read_bounded(Path(self.root, path))
        except OSError:
            return b""


def file_grounds(file: FileInput, *, root: str, folder: str, paths: Iterable[str]) -> Grounds:
    """Return what a file hook may report on: findings in its package, values of the file's entities."""
    own = str(EntityId(EntityKind.FILE, file.path))

    def content(path: str) -> bytes:
        if path == file.path:
            return file.content
        try:
            return read_bounded(Path(root, path))
        except OSError:
            return b""

    return Grounds(
        root=root,
        folders=(folder,),
        paths=paths,
        entities=file.entities,
        own_ids=(own,),
        default_path=file.path,
        default_entity=own,
        package=file.package,
        content=content,
    )


def package_grounds(package: PackageInput, *, root: str) -> Grounds:
    """Return what a package hook may report on: the package, its files and what is in them."""
    own = str(EntityId(EntityKind.PACKAGE, package.package.id))
    return Grounds(
        root=root,
        folders=(package.folder,),
        paths=[file.path for file in package.files],
        entities=package.entities,
        own_ids=(own, *_file_ids(package)),
        default_entity=own,
        package=package.package.id,
    )


def workspace_grounds(workspace: WorkspaceInput) -> Grounds:
    """Return what a workspace or repository hook may report on: everything it was given."""
    kind = EntityKind.REPOSITORY if workspace.repository else EntityKind.WORKSPACE
    own = str(EntityId(kind, workspace.repository or "."))
    packages = workspace.packages
    ids = [str(EntityId(EntityKind.PACKAGE, package.package.id)) for package in packages]
    return Grounds(
        root=workspace.root,
        folders=(),
        paths=[file.path for package in packages for file in package.files],
        entities=[entity for package in packages for entity in package.entities],
        own_ids=(own, *ids, *(name for package in packages for name in _file_ids(package))),
        default_entity=own,
    )


def _file_ids(package: PackageInput) -> Iterable[str]:
    return (str(EntityId(EntityKind.FILE, file.path)) for file in package.files)
