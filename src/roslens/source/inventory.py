"""Which files there are, in which language and role, with which content.

Reading is the cost: a file whose size, time stamp and inode are those of the last run is not opened.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from functools import partial
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import MOST_SOURCE_BYTES, TooLargeError, read_bounded
from roslens.model.failure import Failure
from roslens.model.source import OUTSIDE_PACKAGES, Language, Location, Role, SourceFile
from roslens.source.keys import analyser_version, content_hash, key_of
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.copied_heads import library_of
from roslens.source.workspace.find import FoundFile, FoundPackage, Workspace
from roslens.source.workspace.languages import classify, header_language, language_by_name
from roslens.source.workspace.roles import HEAD, given_role, role_by_path
from roslens.source.workspace.unpacked_projects import unpacked_projects
from roslens.source.workspace.vendored import named_folders, vendored_folders
from roslens.store.cache import FileStat

LARGEST_UNNAMED_BYTES = 1 << 20
"""A larger file whose name does not determine a language is not opened to detect it."""


class Inventory(msgspec.Struct, frozen=True):
    """The files of each package id, what could not be read, and what the cache should learn.

    ``others`` are the paths of the files of each package that have no language of interest: licences, meshes,
    ``setup.cfg``; whether they are there is all that is known of them.
    """

    files: dict[str, tuple[SourceFile, ...]]
    failures: tuple[Failure, ...]
    learned: dict[str, FileStat]
    others: dict[str, tuple[str, ...]] = {}


def take_inventory(workspace: Workspace, settings: WorkspaceSettings, known: Mapping[str, FileStat]) -> Inventory:
    """Classify and hash every file; ``known`` is what the cache remembers.

    Files without a language of interest are left out.
    """
    rules = key_of(analyser_version(), settings)[:8]
    files: dict[str, tuple[SourceFile, ...]] = {}
    failures: list[Failure] = []
    learned: dict[str, FileStat] = {}
    others: dict[str, tuple[str, ...]] = {}
    for found in workspace.packages:
        kept: list[SourceFile] = []
        unnamed: list[str] = []
        for entry in found.files:
            stat = known.get(entry.path)
            if stat is None or not _unchanged(stat, entry, rules):
                looked = _looked_into(workspace.root, found, entry, settings, rules)
                if isinstance(looked, Failure):
                    failures.append(looked)
                    continue
                stat = learned[entry.path] = looked
            if stat.language == Language.OTHER.value:
                unnamed.append(entry.path)
                continue
            kept.append(SourceFile(entry.path, Language(stat.language), Role(stat.role), entry.size, stat.content_hash))
        others[found.package.id] = tuple(unnamed)
        files[found.package.id] = _with_headers(
            _with_vendored(found, _with_libraries(kept, settings, workspace.root), settings, workspace)
        )
    return Inventory(files, tuple(failures), learned, others)


def _looked_into(
    root: str, found: FoundPackage, entry: FoundFile, settings: WorkspaceSettings, rules: str
) -> FileStat | Failure:
    """Return what a file is, or why that cannot be said."""
    try:
        return _look_into(Path(root), entry, settings, rules)
    except TooLargeError as error:
        return _too_large(found, entry, settings, error)
    except OSError as error:
        return _unreadable(found, entry, error)


def _with_vendored(
    found: FoundPackage, files: list[SourceFile], settings: WorkspaceSettings, workspace: Workspace
) -> list[SourceFile]:
    """Return the files, with those marked as work of others that only their folder shows to be so."""
    folders = _folders_of_others(found, workspace)
    if not folders:
        return files
    return [
        msgspec.structs.replace(file, role=Role.VENDORED)
        if file.path.startswith(folders) and given_role(file.path, settings) is None
        else file
        for file in files
    ]


def _folders_of_others(found: FoundPackage, workspace: Workspace) -> tuple[str, ...]:
    """Return the folders of a package with work of others, each with ``/`` at its end."""
    if found.package.copy_of:
        return (f"{found.package.path}/",)
    paths = [entry.path for entry in found.files]
    packages = [one.package.path for one in workspace.packages if one.package.id != OUTSIDE_PACKAGES]
    is_outside = found.package.id == OUTSIDE_PACKAGES
    if is_outside and not packages:
        return named_folders(paths)
    projects = unpacked_projects(
        found.package.path,
        paths,
        _own_names(workspace),
        partial(_text_of, workspace.root),
        packages if is_outside else (),
    )
    if is_outside:
        return (*named_folders(paths, packages), *projects)
    return (*vendored_folders(found.package.path, paths, found.package.name), *projects)


def _own_names(workspace: Workspace) -> frozenset[str]:
    """Return what a text names that is about the workspace: its repository, its packages and their people."""
    packages = [one.package for one in workspace.packages if not one.package.copy_of]
    people = [person for one in packages for person in (*one.maintainers, *one.authors)]
    names = [*(one.name for one in packages), *(text for one in people for text in (one.name, one.email))]
    return frozenset((*workspace.homes, *(name.strip().lower() for name in names)))


def _text_of(root: str, path: str) -> bytes:
    """Return what a file below a root holds; nothing where it is too large, or cannot be read."""
    try:
        return read_bounded(f"{root}/{path}", LARGEST_UNNAMED_BYTES)
    except OSError:
        return b""


def _with_libraries(files: list[SourceFile], settings: WorkspaceSettings, root: str) -> list[SourceFile]:
    """Return the files of a package with those of a library as its own that most of them are of: it is its home."""
    copied = {file.path for file in files if file.role is Role.VENDORED and role_by_path(file.path, settings) is None}
    parsed = sum(file.language.parsed_as != "" for file in files)
    if not copied or 2 * len(copied) <= parsed:
        return files
    library = {path: library_of(_text_of(root, path)[:HEAD]) for path in sorted(copied)}
    home = {name for name, count in Counter(library.values()).items() if 2 * count > parsed}
    return [msgspec.structs.replace(file, role=Role.OWN) if library.get(file.path) in home else file for file in files]


def _with_headers(files: list[SourceFile]) -> tuple[SourceFile, ...]:
    """Return the files with their ``.h`` headers in the language of the package."""
    headers = header_language(file.path for file in files)
    return tuple(
        msgspec.structs.replace(file, language=headers) if _is_open_header(file, headers) else file for file in files
    )


def _is_open_header(file: SourceFile, headers: Language) -> bool:
    return file.path.endswith(".h") and file.language in (Language.C, Language.CPP) and file.language is not headers


def _unchanged(stat: FileStat, entry: FoundFile, rules: str) -> bool:
    return (
        stat.size == entry.size
        and stat.mtime_ns == entry.mtime_ns
        and stat.inode == entry.inode
        and stat.rules == rules
    )


def _look_into(root: Path, entry: FoundFile, settings: WorkspaceSettings, rules: str) -> FileStat:
    named = language_by_name(entry.path)
    if named is Language.OTHER or (named is None and entry.size > LARGEST_UNNAMED_BYTES):
        return FileStat(entry.size, entry.mtime_ns, entry.inode, "", Language.OTHER.value, Role.OWN.value, rules)
    content = read_bounded(f"{root}/{entry.path}")
    classified = classify(entry.path, content, settings)
    return FileStat(
        entry.size,
        entry.mtime_ns,
        entry.inode,
        content_hash(content),
        classified.language.value,
        classified.role.value,
        rules,
    )


def _too_large(found: FoundPackage, entry: FoundFile, settings: WorkspaceSettings, error: TooLargeError) -> Failure:
    """Return the failure of a file that is left out for its size; in code of others it leaves out nothing judged."""
    return Failure(
        tool="syntax",
        what=f"not read: {error.strerror}",
        expected=f"files of source of at most {MOST_SOURCE_BYTES:,} bytes",
        advice="Split it, or add it to `ignore` below [workspace] in roslens.toml",
        location=Location(entry.path),
        package=found.package.id,
        partial=role_by_path(entry.path, settings) not in (None, Role.OWN),
    )


def _unreadable(found: FoundPackage, entry: FoundFile, error: OSError) -> Failure:
    return Failure(
        tool="read",
        what=f"cannot read the file: {error.strerror or error}",
        expected="a file that can be read",
        advice="Check its permissions, or add it to `ignore` below [workspace] in roslens.toml",
        location=Location(entry.path),
        package=found.package.id,
    )
