"""Plug-ins that are installed, found by reading metadata; nothing of them is imported.

The standard look-up imports an e-mail parser and opens every distribution: about 70 ms before the
first answer. Here a folder of the search path is listed once and only the entry points are read
that hold the name of the group.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path

import msgspec

from roslens.plugins.points import ENTRY_POINT_GROUP

HAROS_PREFIX = "haros_plugin_"


class InstalledEntryPoint(msgspec.Struct, frozen=True, order=True):
    """An entry point of the group: ``name = module:attribute`` of a distribution."""

    name: str
    module: str
    attribute: str
    distribution: str
    version: str


class Installed(msgspec.Struct, frozen=True):
    """Entry points and folders of HAROS plug-ins, each sorted by name."""

    entry_points: tuple[InstalledEntryPoint, ...] = ()
    haros: tuple[str, ...] = ()


def find_installed(search: Sequence[str]) -> Installed:
    """Return what the folders of ``search`` (as ``sys.path``) hold.

    The first of two distributions, or HAROS plug-ins, of one name counts, as it does for imports.
    """
    folders = tuple(dict.fromkeys(search))
    return _found(folders, tuple(map(_changed, folders)))


def _changed(folder: str) -> int:
    try:
        return Path(folder).stat().st_mtime_ns
    except OSError:
        return 0


@lru_cache(maxsize=4)
def _found(search: tuple[str, ...], _changed: tuple[int, ...]) -> Installed:
    distributions: dict[str, tuple[InstalledEntryPoint, ...]] = {}
    haros: dict[str, str] = {}
    for folder in search:
        for entry in _list(folder):
            if entry.name.endswith((".dist-info", ".egg-info")):
                name, version = _identity(entry.name)
                distributions.setdefault(name, tuple(_entry_points(Path(entry.path), name, version)))
            elif entry.name.startswith(HAROS_PREFIX) and Path(entry.path, "plugin.yaml").is_file():
                haros.setdefault(entry.name, entry.path)
    points = sorted(point for found in distributions.values() for point in found)
    return Installed(tuple(points), tuple(haros[name] for name in sorted(haros)))


def _list(folder: str) -> Iterator[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as entries:
            yield from sorted(entries, key=lambda entry: entry.name)
    except OSError:
        return


def _identity(folder_name: str) -> tuple[str, str]:
    name, _, version = folder_name.rsplit(".", 1)[0].partition("-")
    return name.lower().replace("_", "-"), version.partition("-")[0]


def _entry_points(folder: Path, distribution: str, version: str) -> Iterator[InstalledEntryPoint]:
    try:
        content = (folder / "entry_points.txt").read_bytes()
    except OSError:
        return
    if ENTRY_POINT_GROUP.encode() not in content:
        return
    inside = False
    for line in content.decode("utf-8", "replace").splitlines():
        text = line.strip()
        if text.startswith("["):
            inside = text == f"[{ENTRY_POINT_GROUP}]"
        elif inside and "=" in text and not text.startswith(("#", ";")):
            name, _, reference = text.partition("=")
            module, _, attribute = reference.partition("[")[0].strip().partition(":")
            yield InstalledEntryPoint(name.strip(), module.strip(), attribute.strip(), distribution, version)
