"""What source says: the workspace of a system, laid out in a folder, and the configuration that it comes to."""

from __future__ import annotations

import shutil
from pathlib import Path

import msgspec

from accuracy.checksums import Checksums
from accuracy.facts import Fact, said
from accuracy.system import ROOT, System, folder_of
from roslens.cli.graph.graph_source import GraphSource
from roslens.model.configuration import Configuration
from roslens.source.settings import SourceSettings

_LEFT = shutil.ignore_patterns(".git", "__pycache__", "*.pyc", "test", "tests")
SHARE_ROS1, SHARE_ROS2 = Path("/usr/share"), ROOT / "build" / "ros2" / "share"


def lay_out(system: System, folder: Path) -> Path:
    """Copy the parts of a system's workspace into a folder and return that with the packages."""
    source = folder / "src"
    for part in system.parts:
        whole = folder_of(part)
        target = source / (part.partition(" > ")[2] or whole.name)
        shutil.copytree(whole, target, ignore=_LEFT, dirs_exist_ok=True)
    return source


def configuration(system: System, folder: Path) -> Configuration:
    """Return what the launch file of a system comes to, by its source alone."""
    with GraphSource(str(folder), SourceSettings(), "roslens.toml", {}, jobs=1) as source:
        return source.launched(system.launch, system.arguments)


def read(system: System, folder: Path) -> tuple[Fact, ...]:
    """Return the facts that the source in a folder says, with checksums of the types that are known."""
    ros1 = system.generation == "ros1"
    folders = (folder / "src", SHARE_ROS1 if ros1 else SHARE_ROS2)
    packages = {path.parent for path in (folder / "src").rglob("package.xml")}
    known = Checksums(1 if ros1 else 2, tuple(sorted({one.parent for one in packages})) + folders)
    found = []
    for one in said(configuration(system, folder)):
        kind = one.values.get("type", "")
        checksum = known.of(kind) if kind and one.kind in _WITH_CHECKSUM[system.generation] else ""
        found.append(msgspec.structs.replace(one, values={**one.values, "hash": checksum}) if checksum else one)
    return tuple(found)


_WITH_CHECKSUM = {
    "ros1": ("publisher", "subscription", "service_server"),
    "ros2": ("publisher", "subscription"),
}
"""Of what a running system tells it."""
