"""The nouns of source code: where things are, files, packages, workspaces."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum

import msgspec


class Location(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """A place in a file: path below the workspace root, 1-based lines and columns (in bytes).

    0 means unknown. ``end_line`` and ``end_column`` name the last character, inclusive.
    """

    path: str
    line: int = 0
    column: int = 0
    end_line: int = 0
    end_column: int = 0

    def __str__(self) -> str:
        """Return ``path:line:column`` with the unknown parts left out."""
        if not self.line:
            return self.path
        return f"{self.path}:{self.line}:{self.column}" if self.column else f"{self.path}:{self.line}"


class Language(str, Enum):
    """What a file is written in."""

    C = "c"
    CPP = "cpp"
    PYTHON = "python"
    CMAKE = "cmake"
    MANIFEST = "manifest"
    LAUNCH_XML = "launch_xml"
    LAUNCH_PYTHON = "launch_python"
    LAUNCH_YAML = "launch_yaml"
    MSG = "msg"
    SRV = "srv"
    ACTION = "action"
    YAML = "yaml"
    XML = "xml"
    URDF = "urdf"
    XACRO = "xacro"
    OTHER = "other"

    @property
    def parsed_as(self) -> str:
        """Name of the syntax that reads it: ``cpp``, ``python`` or an empty text."""
        if self in (Language.C, Language.CPP):
            return "cpp"
        return "python" if self in (Language.PYTHON, Language.LAUNCH_PYTHON) else ""


class Role(str, Enum):
    """What a file is to its package; gates look at ``own`` code unless configured otherwise."""

    OWN = "own"
    TEST = "test"
    GENERATED = "generated"
    VENDORED = "vendored"


class SourceFile(msgspec.Struct, frozen=True, omit_defaults=True):
    """A file of a package. ``path`` is below the workspace root, with ``/``; ``size`` in bytes."""

    path: str
    language: Language
    role: Role = Role.OWN
    size: int = 0
    content_hash: str = ""


class Dependency(msgspec.Struct, frozen=True, omit_defaults=True):
    """One dependency tag of a manifest.

    ``kind`` is the tag without ``_depend`` (``build``, ``build_export``, ``buildtool``,
    ``buildtool_export``, ``exec``, ``run``, ``test``, ``doc``, ``conflict``, ``replace``,
    ``group``) or ``depend``. ``active`` is whether its condition (REP-149) holds.
    """

    name: str
    kind: str
    location: Location
    condition: str = ""
    active: bool = True
    constraints: dict[str, str] = {}


class Person(msgspec.Struct, frozen=True, omit_defaults=True):
    """A maintainer or an author."""

    name: str
    email: str = ""
    location: Location | None = None


class License(msgspec.Struct, frozen=True, omit_defaults=True):
    """A licence statement; ``file`` as in format 3."""

    name: str
    file: str = ""
    location: Location | None = None


class Url(msgspec.Struct, frozen=True, omit_defaults=True):
    """A URL of a manifest: ``kind`` is website, repository or bugtracker."""

    url: str
    kind: str = "website"
    location: Location | None = None


class Export(msgspec.Struct, frozen=True, omit_defaults=True):
    """A tag below ``<export>``: its text, attributes and, as one text, its children.

    ``active`` is whether its condition (REP-149) holds.
    """

    tag: str
    location: Location
    text: str = ""
    attributes: dict[str, str] = {}
    content: str = ""
    active: bool = True


class Package(msgspec.Struct, frozen=True, omit_defaults=True):
    """A ROS package as its manifest (REP-127, REP-140, REP-149) declares it.

    ``path`` is the folder below the workspace root (``.`` for the root itself); ``manifest`` the
    place of its name. ``build_type`` is catkin, ament_cmake, ament_python, cmake or what the
    manifest says. ``id`` is the entity name: ``name``, or ``name@path`` where the name is doubled.
    Files that belong to no package live in a package whose ``id`` is ``(outside packages)``.
    ``copy_of`` is the project that the package was copied from, with its version; empty where it is at home.
    """

    id: str
    name: str
    path: str
    manifest: Location
    format: int = 1
    version: str = ""
    build_type: str = ""
    description: str = ""
    metapackage: bool = False
    deprecated: str = ""
    dependencies: tuple[Dependency, ...] = ()
    member_of_groups: tuple[Dependency, ...] = ()
    maintainers: tuple[Person, ...] = ()
    authors: tuple[Person, ...] = ()
    licenses: tuple[License, ...] = ()
    urls: tuple[Url, ...] = ()
    exports: tuple[Export, ...] = ()
    repository: str = ""
    copy_of: str = ""


OUTSIDE_PACKAGES = "(outside packages)"
"""Id of what holds the files that are in no package: shown among packages, but no package in any count."""


def number_of_packages(ids: Iterable[str]) -> int:
    """Return how many packages there are among ids of packages: neither what is outside of them, nor all together."""
    return sum(one not in ("", OUTSIDE_PACKAGES) for one in ids)
