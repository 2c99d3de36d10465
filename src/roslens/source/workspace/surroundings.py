"""What a package has around it in its workspace: a package whose folder it is in, and those that ask for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from posixpath import basename, dirname

import msgspec

from roslens.model.source import OUTSIDE_PACKAGES, Language, Package, SourceFile
from roslens.source.distributions.target import Target
from roslens.source.workspace.dependents import Dependents, dependents_of

_SOURCES = "src/"
_STARTING = (Language.LAUNCH_XML, Language.LAUNCH_PYTHON, Language.LAUNCH_YAML)
_NAMING = (Language.YAML, Language.XACRO, Language.URDF, Language.PYTHON)
_DEFINITIONS = (Language.MSG, Language.SRV, Language.ACTION)


class Started(msgspec.Struct, frozen=True, omit_defaults=True):
    """What starts nodes in a workspace, so that the findings of a package may depend on it.

    Attributes:
        paths: of the launch files, sorted.
        digest: of these files and of all files of parameters.
    """

    paths: tuple[str, ...] = ()
    digest: str = ""


class Surroundings(msgspec.Struct, frozen=True, omit_defaults=True):
    """What rules on one package need to know of the others.

    Attributes:
        inside: path of the nearest package around its folder; empty where there is none. Neither colcon nor catkin
            looks for packages there.
        asked_by: names of the packages that depend on it, sorted.
        launched_by: launch files in XML of these, where it has any that they could include.
        users: sources and definitions of these, where it has definitions of messages and no code of its own.
        folders: of the packages of the workspace, by name, where it has launch files, which name others.
        started: launch files, and files of parameters, of all these packages.
        target: what it is built for.
        own: names of the packages of the workspace that it depends on, sorted: what these have is there, whatever a
            distribution has.
        dependents: names of the packages that depend on it, also through others, sorted; with each, whether one of the
            dependencies on the way is of a build or a test.
        declared: what any package of the workspace declares, sorted, where it may name plug-ins or libraries.
        definitions: the messages, services and actions of these and of its own, as ``msg/Load``, by package.
    """

    inside: str = ""
    asked_by: tuple[str, ...] = ()
    launched_by: tuple[SourceFile, ...] = ()
    users: tuple[SourceFile, ...] = ()
    folders: tuple[tuple[str, str], ...] = ()
    started: Started = Started()
    target: Target = Target()
    own: tuple[str, ...] = ()
    dependents: Dependents = ()
    declared: tuple[str, ...] = ()
    definitions: tuple[tuple[str, tuple[str, ...]], ...] = ()


def surroundings_of(
    packages: Sequence[Package], files: Mapping[str, Sequence[SourceFile]], targets: Mapping[str, Target]
) -> Mapping[str, Surroundings]:
    """Return what is around each package, by its id.

    Args:
        packages: of the workspace.
        files: of each, by its id.
        targets: what each is built for, by its id.
    """
    own = [one for one in packages if one.id != OUTSIDE_PACKAGES]
    every = tuple(sorted((one.name, one.path) for one in own))
    started = _started([file for one in own for file in files.get(one.id, ())])
    folders = frozenset(one.path for one in own)
    names = frozenset(one.name for one in own)
    dependents = dependents_of(own)
    defined = _defined(own, files)
    declared = _declared(own)
    asking: dict[str, dict[str, Package]] = {}
    for one in own:
        for dependency in one.dependencies:
            if dependency.name != one.name:
                asking.setdefault(dependency.name, {})[one.id] = one
    found: dict[str, Surroundings] = {}
    for one in own:
        by = sorted(asking.get(one.name, {}).values(), key=lambda other: other.path)
        launched_by = tuple(file for other in by for file in files.get(other.id, ()) if _is_launched(file))
        if not any(map(_is_launched, files.get(one.id, ()))):
            launched_by = ()
        inside = next((above for above in _above(one.path) if above in folders), "")
        users = tuple(file for other in by for file in files.get(other.id, ()) if _may_use(file))
        asked = tuple(sorted(names & {one.name, *(dependency.name for dependency in one.dependencies)}))
        starts = any(file.language in _STARTING for file in files.get(one.id, ()))
        found[one.id] = Surroundings(
            inside,
            tuple(sorted({other.name for other in by})),
            launched_by,
            users if _is_of_definitions(files.get(one.id, ())) else (),
            every if starts else (),
            started if starts else Started(),
            targets.get(one.id, Target()),
            asked,
            dependents[one.name],
            _named_among(declared, files.get(one.id, ())),
            tuple((name, defined[name]) for name in asked if name in defined),
        )
    return found


def _started(files: Sequence[SourceFile]) -> Started:
    read = sorted((file.path, file.content_hash) for file in files if file.language in (*_STARTING, Language.YAML))
    paths = tuple(sorted(file.path for file in files if file.language in _STARTING))
    return Started(paths, sha256(repr(read).encode()).hexdigest()[:32])


def _defined(packages: Sequence[Package], files: Mapping[str, Sequence[SourceFile]]) -> Mapping[str, tuple[str, ...]]:
    """Return what packages define, by their name; of packages of one name together."""
    found: dict[str, set[str]] = {}
    for one in packages:
        for file in files.get(one.id, ()):
            if file.language in _DEFINITIONS:
                kind = file.language.value.lower()
                found.setdefault(one.name, set()).add(f"{kind}/{basename(file.path).rpartition('.')[0]}")
    return {name: tuple(sorted(of)) for name, of in found.items()}


def _declared(packages: Sequence[Package]) -> tuple[str, ...]:
    return tuple(sorted({dependency.name for one in packages for dependency in one.dependencies}))


def _named_among(declared: tuple[str, ...], files: Sequence[SourceFile]) -> tuple[str, ...]:
    """Return what is declared, where files may name plug-ins or import libraries."""
    return declared if any(file.language in _NAMING for file in files) else ()


def _is_launched(file: SourceFile) -> bool:
    return file.language is Language.LAUNCH_XML


def _may_use(file: SourceFile) -> bool:
    return file.language.parsed_as != "" or file.language in _DEFINITIONS


def _is_of_definitions(files: Sequence[SourceFile]) -> bool:
    """Return whether a package defines messages and has no sources that could use them."""
    has_code = any(file.language.parsed_as and file.language not in _STARTING for file in files)
    return not has_code and any(file.language in _DEFINITIONS for file in files)


def _above(path: str) -> Iterator[str]:
    """Yield the folders around one, the nearest first; the root of the workspace is ``.``.

    It is none for what lies in its ``src``: builds of workspaces are told to begin there.
    """
    last = "" if path.startswith(_SOURCES) else "."
    while path not in ("", "."):
        path = dirname(path) or last
        if path:
            yield path
