"""The interfaces of a workspace with what identifies them on the wire."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.intake.file_budget import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.source import Language, Location, Package, SourceFile
from roslens.source.extract.facts.files import folders_in_common
from roslens.source.extract.interfaces.interface import Checksum, Interface, Lookup
from roslens.source.extract.interfaces.interface_file import read_interface
from roslens.source.extract.interfaces.message_md5 import md5_of
from roslens.source.extract.interfaces.type_hash import type_hash
from roslens.source.over_budget import over_budget

INTERFACES = frozenset({Language.MSG, Language.SRV, Language.ACTION})
Outside = Callable[[int, str], "Interface | None"]
"""Finds an interface that no package of the workspace has, by generation and full name."""
_Key = tuple[int, str, str]
"""Generation, name, and id of the package of an interface."""
_ROS2 = frozenset({"rosidl_default_generators", "rclcpp", "rclpy", "ament_cmake", "ament_cmake_auto"})


class KnownInterface(msgspec.Struct, frozen=True, omit_defaults=True):
    """An interface, the file it is in, and its checksum: MD5 of ROS 1, RIHS01 of ROS 2."""

    interface: Interface
    path: str
    checksum: Checksum


def ros_generation(package: Package) -> int:
    """Return for which ROS a package is built, 1 or 2: by its build type, else by its dependencies."""
    if package.build_type.startswith("ament"):
        return 2
    if package.build_type == "catkin":
        return 1
    return 2 if any(one.name in _ROS2 for one in package.dependencies) else 1


def interfaces_of(
    root: str,
    files: Mapping[str, Iterable[SourceFile]],
    packages: Iterable[Package],
    outside: Outside = lambda _generation, _name: None,
) -> tuple[tuple[KnownInterface, ...], tuple[Failure, ...]]:
    """Return the interfaces of packages, sorted by name, and what of them could not be read or understood.

    Two packages of one name each have theirs; an interface that another one is made of is that of its own package, else
    the first.

    Args:
        root: folder that paths start from.
        files: of each package, by its id.
        packages: in whose order the first of two interfaces of one name counts.
        outside: finds what the packages do not have, by generation and full name.
    """
    found: dict[_Key, tuple[str, Interface]] = {}
    failures: list[Failure] = []
    for package in packages:
        generation = ros_generation(package)
        for file in sorted(files.get(package.id, ()), key=lambda one: one.path):
            if file.language not in INTERFACES:
                continue
            try:
                content = read_bounded(f"{root}/{file.path}")
                with file_budget(file.path, size=len(content)):
                    interface, wrong = read_interface(content, file.path, package.name, generation)
            except OverBudgetError as error:
                failures.append(over_budget(file, error, package=package.id))
                continue
            except Exception as error:  # noqa: BLE001 - one file must not lose the others
                failures.append(_broken(file, package, error))
                continue
            failures += [msgspec.structs.replace(one, package=package.id) for one in wrong]
            found.setdefault((generation, interface.full_name, package.id), (file.path, interface))
    firsts: dict[tuple[int, str], Interface] = {}
    for (generation, name, _), (_, interface) in found.items():
        firsts.setdefault((generation, name), interface)
    known = [
        KnownInterface(interface, path, _checksum(interface, _lookup(found, firsts, generation, package_id, outside)))
        for (generation, _, package_id), (path, interface) in sorted(found.items())
    ]
    return tuple(known), tuple(failures)


def nearest(known: Sequence[KnownInterface], path: str) -> KnownInterface:
    """Return which of several interfaces of one name is meant in a file: the one with the most folders in common."""
    return max(known, key=lambda one: folders_in_common(one.path, path))


def _lookup(
    found: Mapping[_Key, tuple[str, Interface]],
    firsts: Mapping[tuple[int, str], Interface],
    generation: int,
    package_id: str,
    outside: Outside,
) -> Lookup:
    def lookup(name: str) -> Interface | None:
        own = found.get((generation, name, package_id))
        if own is not None:
            return own[1]
        return firsts.get((generation, name)) or outside(generation, name)

    return lookup


def _checksum(interface: Interface, lookup: Lookup) -> Checksum:
    try:
        return (md5_of if interface.generation == 1 else type_hash)(interface, lookup)
    except Exception as error:  # noqa: BLE001 - one interface must not lose the others
        return Checksum(unknown=f"{type(error).__name__}: {error}")


def _broken(file: SourceFile, package: Package, error: Exception) -> Failure:
    readable = not isinstance(error, OSError)
    return Failure(
        tool="interfaces" if readable else "read",
        what=f"{type(error).__name__}: {error}",
        expected="an interface" if readable else "a file that can be read",
        advice="Please report it with the file: this is a bug in roslens" if readable else "Check its permissions",
        location=Location(file.path),
        entity=str(EntityId(EntityKind.FILE, file.path)),
        package=package.id,
        partial=True,
    )
