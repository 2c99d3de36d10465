"""The packages below given paths and the files of each, from one walk over the folders.

Nothing is opened but manifests, change logs and the configuration of the repository.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence, Set
from functools import cache, partial
from operator import attrgetter
from pathlib import Path
from posixpath import basename, dirname

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.intake.file_budget import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.source import OUTSIDE_PACKAGES, Language, Location, Package
from roslens.source.commit import committers_of
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.copied_packages import CHANGE_LOG, Candidate, copied_packages
from roslens.source.workspace.globs import compiled
from roslens.source.workspace.languages import language_by_name
from roslens.source.workspace.manifest import MANIFEST_NAME, MAXIMUM_SIZE, nameless_package, read_manifest
from roslens.source.workspace.outputs import OUTPUT_NAMES
from roslens.source.workspace.walk import FoundFile, PackageFolder, Walked, repository_of, walk

__all__ = ["FoundFile", "FoundPackage", "ManifestReader", "Workspace", "find_workspace", "root_of"]

ManifestReader = Callable[[bytes, str, Mapping[str, str]], tuple[Package | None, tuple[Failure, ...]]]
"""Takes content, path and environment as :func:`read_manifest` does; a cached one saves its time."""


_path: Callable[[FoundFile], str] = attrgetter("path")


class FoundPackage(msgspec.Struct, frozen=True):
    """A package, its absolute folder and its files, sorted by path; none of them belongs to a package inside it."""

    package: Package
    folder: str
    files: tuple[FoundFile, ...]


class Workspace(msgspec.Struct, frozen=True):
    """The packages found, sorted by path, and what could not be read. ``root`` is absolute.

    ``hidden`` are folders with packages that an ignore marker hides, with its name. ``homes`` are the names that the
    repository around the root has, and its owners, in lower case; none where there is no checkout.
    """

    root: str
    packages: tuple[FoundPackage, ...]
    failures: tuple[Failure, ...]
    hidden: tuple[tuple[str, str], ...] = ()
    homes: tuple[str, ...] = ()


def find_workspace(
    paths: Sequence[str | Path], settings: WorkspaceSettings, *, read: ManifestReader = read_manifest
) -> Workspace:
    """Find the packages below ``paths``; what is above them is not looked at.

    The root is the given folder, or what several given folders have in common. Source files in no package make up a
    package with the id ``(outside packages)``. Packages of the same name all get an id ``name@path``.

    Args:
        paths: folders; none means the current one. The path of a package.xml means its folder.
        settings: what to ignore, and the environment for conditions.
        read: reads a manifest.

    Raises:
        UsageError: a path does not exist or is a file.
    """
    starts = _starts(paths)
    root = _common(starts)
    seen = walk(root, starts, compiled(settings.ignore))
    seen.repositories.update(_repositories_above(root, starts))
    failures = list(seen.failures)
    packages = [_package(folder, root, settings, seen.repositories, read, failures) for folder in seen.packages[1:]]
    top = next((folder for folder in (Path(root), *Path(root).parents) if os.path.lexists(folder / ".git")), None)
    packages = _distinct(packages, failures)
    if top is not None:
        projects = _projects([*(file for one in packages for file in one.files), *seen.packages[0].files])
        packages = _with_copies(packages, root, seen.repositories, _names_of(top), projects)
    if outside := _outside(seen.packages[0]):
        packages.append(outside)
    packages.sort(key=lambda found: (found.package.path, found.package.id))
    if not packages:
        failures.append(_empty(starts, root, seen))
    failures.sort(key=_place)
    hidden = tuple((path, marker) for path, marker in sorted(seen.hidden.items()) if _has_package(root, path))
    homes = () if top is None else tuple(sorted({basename(root).lower(), *_names_of(top), *_owners_of(top)}))
    return Workspace(root, tuple(packages), tuple(failures), hidden, homes)


def root_of(paths: Sequence[str | Path]) -> Path:
    """Return the root that :func:`find_workspace` takes for ``paths``.

    Raises:
        UsageError: a path does not exist or is a file.
    """
    return Path(_common(_starts(paths)))


def _starts(paths: Sequence[str | Path]) -> list[str]:
    """Return the resolved folders, sorted, without those inside another one."""
    found: list[str] = []
    for folder in sorted({_folder(path) for path in paths or (".",)}):
        if not any(folder.startswith(start.rstrip("/") + "/") for start in found):
            found.append(folder)
    return found


def _folder(path: str | Path) -> str:
    given = Path(path)
    if given.is_dir():
        return os.path.realpath(given)
    if given.name == MANIFEST_NAME and given.is_file():
        return os.path.realpath(given.parent)
    if os.path.lexists(given):
        raise UsageError(
            f'"{path}" is not a folder', expected="folders with packages", advice="Give the folder it is in."
        )
    raise UsageError(
        f'"{path}" does not exist', expected="folders with packages", advice="Check the path and the current folder."
    )


def _common(starts: Sequence[str]) -> str:
    return starts[0] if len(starts) == 1 else os.path.commonpath(starts)


def _repositories_above(root: str, starts: Sequence[str]) -> set[str]:
    """Return the folders from the root down to the given ones, below the root, that hold ``.git``."""
    top = Path(root)
    folders = {parent for start in starts for parent in Path(start).parents if parent.is_relative_to(top)}
    holding = (folder.relative_to(top).as_posix() for folder in folders if os.path.lexists(folder / ".git"))
    return {"" if path == "." else path for path in holding}


def _package(
    folder: PackageFolder,
    root: str,
    settings: WorkspaceSettings,
    repositories: set[str],
    read: ManifestReader,
    failures: list[Failure],
) -> FoundPackage:
    path = f"{folder.path}/{MANIFEST_NAME}" if folder.path else MANIFEST_NAME
    package: Package | None = None
    try:
        content = read_bounded(f"{folder.folder}/{MANIFEST_NAME}", MAXIMUM_SIZE)
        with file_budget(path, size=len(content)):
            package, wrong = read(content, path, settings.environment)
    except OverBudgetError as error:
        wrong = (
            Failure(
                "workspace",
                f"the manifest is left out: {error}",
                "a package.xml of some kilobytes",
                "Check its content; the folder names the package until then.",
                Location(path),
                entity=f"file:{path}",
                partial=True,
            ),
        )
    except OSError as error:
        what = f"the manifest cannot be read, {error.strerror}"
        wrong = (
            Failure(
                "workspace",
                what,
                "a package.xml that can be read",
                "Check its size and permissions; the folder names the package until then.",
                Location(path),
                entity=f"file:{path}",
                partial=True,
            ),
        )
    if package is None:
        package = nameless_package(Path(folder.folder).name or "root", folder.path or ".", path)
    repository = repository_of(folder.path, repositories, root)
    failures.extend(f if f.package else msgspec.structs.replace(f, package=package.id) for f in wrong)
    files = tuple(sorted(folder.files, key=_path))
    return FoundPackage(msgspec.structs.replace(package, repository=repository), folder.folder, files)


def _distinct(packages: list[FoundPackage], failures: list[Failure]) -> list[FoundPackage]:
    """Return the packages with ids that no two of them share; each name that is doubled is a failure."""
    places: dict[str, list[Package]] = {}
    for found in packages:
        places.setdefault(found.package.name, []).append(found.package)
    doubled = {name: group for name, group in places.items() if len(group) > 1}
    if not doubled:
        return packages
    for name, group in doubled.items():
        where = ", ".join(f'"{package.path}"' for package in group)
        failures.append(
            Failure(
                "workspace",
                f'{len(group)} packages have the name "{name}", in {where}',
                "each name once in a workspace",
                f'Rename or hide (COLCON_IGNORE) all but one; they are shown as "{name}@<path>".',
                group[1].manifest,
                package=f"{name}@{group[1].path}",
                partial=True,
            )
        )
    renamed = {package.path: f"{name}@{package.path}" for name, group in doubled.items() for package in group}
    for number, failure in enumerate(failures):
        if failure.package in doubled and failure.location:
            place = dirname(failure.location.path) or "."
            failures[number] = msgspec.structs.replace(failure, package=renamed.get(place, failure.package))
    return [
        msgspec.structs.replace(found, package=msgspec.structs.replace(found.package, id=renamed[found.package.path]))
        if found.package.path in renamed
        else found
        for found in packages
    ]


_MOST = 1 << 20
_LICENCE = re.compile(r"(?:licen[cs]e|copying)(?:\.\w+)?$", re.IGNORECASE)
_READ_FIRST = re.compile(r"readme(?:\.\w+)?$", re.IGNORECASE)
_REMOTE = re.compile(rb"^\s*url\s*=.*?([\w.-]+?)(?:\.git)?/?\s*$", re.MULTILINE)
_OWNER = re.compile(rb"^\s*url\s*=\s*(?:\w+://|[\w.-]+@)[\w.@-]+(?::\d+)?[/:]([\w.-]+)/[\w.-]+/?\s*$", re.MULTILINE)


def _with_copies(
    packages: list[FoundPackage], root: str, repositories: Set[str], names: Set[str], projects: tuple[str, ...]
) -> list[FoundPackage]:
    """Return the packages, those named that were copied from elsewhere into the repository that the root is in.

    ``names`` are those of the repository, ``projects`` the folders that have all that a project has.
    """
    checkouts = tuple(f"{folder}/" for folder in repositories if folder)
    copied = copied_packages(
        [
            Candidate(
                found.package,
                _log_of(found, root),
                own_checkout=f"{found.package.path}/".startswith(checkouts),
                in_project=f"{dirname(found.package.path)}/".startswith(projects),
            )
            for found in packages
        ],
        {basename(root).lower(), *names},
        cache(partial(committers_of, root)),
    )
    return [
        msgspec.structs.replace(found, package=msgspec.structs.replace(found.package, copy_of=copied[found.package.id]))
        if found.package.id in copied
        else found
        for found in packages
    ]


def _projects(files: Sequence[FoundFile]) -> tuple[str, ...]:
    """Return the folders below the root that have a licence and a text to read first, each with ``/`` at its end."""
    licensed: set[str] = set()
    described: set[str] = set()
    for file in files:
        folder, _, name = file.path.rpartition("/")
        if folder and _LICENCE.match(name):
            licensed.add(f"{folder}/")
        elif folder and _READ_FIRST.match(name):
            described.add(f"{folder}/")
    return tuple(sorted(licensed & described))


def _log_of(found: FoundPackage, root: str) -> Callable[[], bytes] | None:
    """Return what reads a package's change log; None where it has none."""
    wanted = f"{found.package.path}/{CHANGE_LOG}" if found.package.path != "." else CHANGE_LOG
    if all(file.path != wanted for file in found.files):
        return None
    return lambda: _content(f"{root}/{wanted}")


def _names_of(checkout: Path) -> Set[str]:
    """Return the names of the repository that is checked out in a folder, in lower case: its, and its remotes'."""
    remotes = _REMOTE.findall(_content(f"{checkout}/.git/config"))
    return {checkout.name.lower(), *(name.decode("utf-8", "replace").lower() for name in remotes)}


def _owners_of(checkout: Path) -> Set[str]:
    """Return the owners that the remotes of the repository in a folder name, in lower case."""
    found = _OWNER.findall(_content(f"{checkout}/.git/config"))
    return {name.decode("utf-8", "replace").lower() for name in found}


def _content(path: str) -> bytes:
    """Return what a file holds; nothing where it is too large, or cannot be read."""
    try:
        return read_bounded(path, _MOST)
    except OSError:
        return b""


_SOURCE = frozenset(
    (
        Language.C,
        Language.CPP,
        Language.PYTHON,
        Language.LAUNCH_PYTHON,
        Language.LAUNCH_XML,
        Language.LAUNCH_YAML,
        Language.MSG,
        Language.SRV,
        Language.ACTION,
        Language.URDF,
        Language.XACRO,
    )
)


def _outside(folder: PackageFolder) -> FoundPackage | None:
    """Return the pseudo package of the source files in no package, with their CMake files."""
    source = [file for file in folder.files if _is_source(file.path)]
    if not source:
        return None
    kept = source + [file for file in folder.files if language_by_name(file.path) is Language.CMAKE]
    package = Package(
        id=OUTSIDE_PACKAGES,
        name=OUTSIDE_PACKAGES,
        path=".",
        manifest=Location("."),
        description="Source files that belong to no package",
    )
    return FoundPackage(package, folder.folder, tuple(sorted(kept, key=_path)))


def _is_source(path: str) -> bool:
    language = language_by_name(path)
    # Where the content decides what it is, it is source either way.
    return language in _SOURCE or (language is None and path.endswith((".py", ".test")))


def _empty(starts: Sequence[str], root: str, seen: Walked) -> Failure:
    where = os.path.relpath(starts[0], root) if len(starts) > 1 else "."
    advice = "Give the folder of a package or of a workspace."
    if seen.hidden:
        path, marker = min(seen.hidden.items())
        advice = f'Remove "{marker}", which hides "{path}", or give another folder.'
    elif around := _package_around(starts[0]):
        advice = f'Give "{around}", the package around it.'
    return Failure(
        "workspace",
        "no package and no source file below " + ", ".join(f'"{start}"' for start in starts),
        f"folders with a {MANIFEST_NAME}",
        advice,
        Location(where),
    )


def _has_package(root: str, path: str) -> bool:
    """Return whether a package is in a hidden folder that is no output of a build: builds hide theirs, too."""
    if not OUTPUT_NAMES.isdisjoint(path.split("/")):
        return False
    return any(MANIFEST_NAME in names for _, _, names in os.walk(f"{root}/{path}"))


def _package_around(folder: str) -> str:
    for parent in Path(folder).parents:
        if (parent / MANIFEST_NAME).is_file():
            return str(parent)
    return ""


def _place(failure: Failure) -> tuple[Location, str]:
    return failure.location or Location(""), failure.what
