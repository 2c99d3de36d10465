"""What a package has around it in its workspace: a package whose folder it is in, and those that ask for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from posixpath import dirname

import msgspec

from roslens.model.source import OUTSIDE_PACKAGES, Language, Package, SourceFile

_SOURCES = "src/"


class Surroundings(msgspec.Struct, frozen=True, omit_defaults=True):
    """What rules on one package need to know of the others.

    Attributes:
        inside: path of the nearest package around its folder; empty where there is none. Neither colcon nor catkin
            looks for packages there.
        asked_by: names of the packages that depend on it, sorted.
        launched_by: launch files in XML of these, where it has any that they could include.
    """

    inside: str = ""
    asked_by: tuple[str, ...] = ()
    launched_by: tuple[SourceFile, ...] = ()


def surroundings_of(
    packages: Sequence[Package], files: Mapping[str, Sequence[SourceFile]]
) -> Mapping[str, Surroundings]:
    """Return what is around each package, by its id.

    Args:
        packages: of the workspace.
        files: of each, by its id.
    """
    own = [one for one in packages if one.id != OUTSIDE_PACKAGES]
    folders = frozenset(one.path for one in own)
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
        found[one.id] = Surroundings(inside, tuple(sorted({other.name for other in by})), launched_by)
    return found


def _is_launched(file: SourceFile) -> bool:
    return file.language is Language.LAUNCH_XML


def _above(path: str) -> Iterator[str]:
    """Yield the folders around one, the nearest first; the root of the workspace is ``.``.

    It is none for what lies in its ``src``: builds of workspaces are told to begin there.
    """
    last = "" if path.startswith(_SOURCES) else "."
    while path not in ("", "."):
        path = dirname(path) or last
        if path:
            yield path
