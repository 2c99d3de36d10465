"""The interfaces of a workspace at one time, and how two of these differ."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import msgspec

from roslens.model.failure import Failure
from roslens.model.interfaces.interface_change import InterfaceChange, InterfaceDifference, VersionStep
from roslens.model.source import OUTSIDE_PACKAGES, Language, SourceFile
from roslens.source.extract.interfaces.interface_changes import Placed, changes_of
from roslens.source.extract.interfaces.published_interfaces import published_interface
from roslens.source.extract.workspace.workspace_interfaces import KnownInterface, interfaces_of
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import find_workspace

_LANGUAGES = {".msg": Language.MSG, ".srv": Language.SRV, ".action": Language.ACTION}
_MANIFEST = "package.xml"
_MARKERS = ("COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE")
_NUMBERS = re.compile(r"(\d+)\.(\d+)\.(\d+)")


class InterfaceState(msgspec.Struct, frozen=True):
    """Interfaces, sorted by name, the versions of their packages, and what of them could not be understood."""

    interfaces: tuple[KnownInterface, ...]
    versions: dict[str, str]
    failures: tuple[Failure, ...] = ()

    @property
    def placed(self) -> dict[str, Placed]:
        """Each with its path by its full name; of two of one name the first."""
        found: dict[str, Placed] = {}
        for one in self.interfaces:
            found.setdefault(one.interface.full_name, (one.interface, one.path))
        return found

    @property
    def checksums(self) -> dict[str, str]:
        """The checksum of each, empty where it is unknown, by its full name."""
        found: dict[str, str] = {}
        for one in self.interfaces:
            found.setdefault(one.interface.full_name, one.checksum.text)
        return found


def is_of_interfaces(path: str) -> bool:
    """Return whether a file has a say in which interfaces a workspace has."""
    name = path.rpartition("/")[2]
    return name == _MANIFEST or name in _MARKERS or _is_one(path)


def _is_one(path: str) -> bool:
    return path.endswith(tuple(_LANGUAGES))


def interface_state(root: str | Path, settings: SourceSettings) -> InterfaceState:
    """Return the interfaces of the packages below a folder.

    Raises:
        UsageError: there is no such folder.
    """
    workspace = find_workspace([root], settings.workspace)
    files = {
        found.package.id: [
            SourceFile(one.path, _LANGUAGES[Path(one.path).suffix]) for one in found.files if _is_one(one.path)
        ]
        for found in workspace.packages
        if found.package.id != OUTSIDE_PACKAGES
    }
    packages = [one.package for one in workspace.packages if files.get(one.package.id)]
    interfaces, failures = interfaces_of(str(workspace.root), files, packages, published_interface)
    return InterfaceState(interfaces, {one.name: one.version for one in packages}, failures)


def interface_difference(before: InterfaceState, after: InterfaceState) -> InterfaceDifference:
    """Return how two states differ; who is affected is not known here."""
    changes = tuple(changes_of(before.placed, after.placed))
    alone = InterfaceDifference(changes)
    containing = _containing(after.placed, alone.on_wire)
    affected = alone.on_wire | containing.keys()
    old, new = before.checksums, after.checksums
    return InterfaceDifference(
        changes,
        containing,
        {one: (old.get(one, ""), new.get(one, "")) for one in sorted(affected)},
        tuple(_steps(before.versions, after.versions, changes)),
        unread=tuple(sorted({str(one.location) for one in (*before.failures, *after.failures) if one.location})),
    )


def _containing(known: Mapping[str, Placed], changed: frozenset[str]) -> dict[str, tuple[str, ...]]:
    """Return the interfaces that contain changed ones, directly or not, with the changed ones."""
    inside = {
        name: {field.type.message for part in interface.parts for field in part.fields if field.type.message}
        for name, (interface, _) in known.items()
    }
    reached: dict[str, set[str]] = {name: {one for one in below if one in changed} for name, below in inside.items()}
    grown = True
    while grown:
        grown = False
        for name, below in inside.items():
            more = set().union(*(reached.get(one, set()) for one in below)) - reached[name] if below else set()
            if more:
                reached[name] |= more
                grown = True
    return {name: tuple(sorted(of)) for name, of in sorted(reached.items()) if of and name not in changed}


def _steps(
    before: Mapping[str, str], after: Mapping[str, str], changes: tuple[InterfaceChange, ...]
) -> list[VersionStep]:
    found = []
    for package in sorted({one.interface.partition("/")[0] for one in changes}):
        if package not in before or package not in after:
            continue
        own = [one for one in changes if one.interface.partition("/")[0] == package]
        old = _NUMBERS.match(before[package])
        new = _NUMBERS.match(after[package])
        if old is None or new is None:
            continue
        was, now = (tuple(map(int, one.groups())) for one in (old, new))
        step = "major" if any(one.breaks for one in own) else "minor"
        # Below 1.0.0 the second number says what breaks (semver.org, 4; REP-2004 asks for it from 1.0.0 on).
        least = (was[0] + 1, 0, 0) if step == "major" and was[0] else (was[0], was[1] + 1, 0)
        text = ".".join(map(str, least))
        found.append(VersionStep(package, before[package], after[package], step, text, now >= least))
    return found
