"""Rule ``package.export_missing``: a file that the manifest exports, and that is not where others look for it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from posixpath import normpath

from roslens.model.source import Export
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ID = "package.export_missing"
_PREFIX = re.compile(r"\$\{prefix\}/(?P<path>[^$\s]+\.\w+)")
_READ_IN_ROS2 = frozenset({"rqt_gui"})
"""Exports of package.xml that something reads in ROS 2: pluginlib takes what CMake writes into the index instead."""
_FOR_DOCUMENTS = frozenset({"rosdoc"})
"""Exports that no program of the robot reads."""
_OPEN = re.compile(r"\$|[*?]|GLOB")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each file below ``${prefix}`` of an export that does not exist, or that no rule installs."""
    for export in view.package.exports:
        if not export.active or export.tag in _FOR_DOCUMENTS or (1 not in view.ros and export.tag not in _READ_IN_ROS2):
            continue
        for written in export.attributes.values():
            match = _PREFIX.fullmatch(written.strip())
            if match is not None:
                yield from _of_export(export, normpath(match["path"]), view)


def _of_export(export: Export, path: str, view: PackageView) -> Iterator[Hit]:
    place = export.location
    name = path.rpartition("/")[2]
    if not view.exists(view.path(path)):
        if name.rpartition(".")[0] in view.cmake.text:
            # CMake makes or downloads it.
            return
        near = next((one for one in sorted(view.listing) if one.endswith(f"/{name}") or one == name), "")
        expected = f"the path {near!r}" if near else "a file of the package"
        message = f"<{export.tag}> exports {path!r}, which does not exist; expected {expected}"
        yield Hit(_ID, message, place.line, place.column, context=path, path=place.path)
    elif view.ros == {1} and _installs_targets(view) and not _is_installed(path, view):
        message = (
            f"<{export.tag}> exports {path!r}, which no rule of CMakeLists.txt installs; expected install(FILES {path} "
            "DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})"
        )
        yield Hit(_ID, message, place.line, place.column, context=path, path=place.path)


def _installs_targets(view: PackageView) -> bool:
    """Return whether the package is meant to be installed: the devel space finds what nobody installs."""
    return any(one.words[:1] == ("TARGETS",) for one in view.cmake.named("install"))


def _is_installed(path: str, view: PackageView) -> bool:
    """Return whether a command may install a file: it names it or a folder around it, or what it names is open."""
    folders = {"", ".", *(path[:at] for at, sign in enumerate(path) if sign == "/")}
    for one in view.cmake.commands:
        if "install" not in one.name:
            continue
        words = [word for word in one.words if "DESTINATION" not in word]
        if one.name != "install":
            return True
        if words[:1] in (["FILES"], ["DIRECTORY"], ["PROGRAMS"]):
            listed = words[1:]
            if any(normpath(word) == path or normpath(word) in folders or _OPEN.search(word) for word in listed):
                return True
    return False


RULE = PackageRule(
    id=_ID,
    title="Exported file that is not there",
    finds="In a package for ROS 1, a file below `${prefix}` that an element of `<export>` names "
    '(`plugin="${prefix}/plugins.xml"`) and that is '
    "not in the package, or, where the package installs its libraries, one that no `install` command names, neither by "
    "itself nor by a folder around it. In ROS 2 pluginlib does not read the manifest; of exports there only those for "
    "`rqt_gui` are looked at.",
    why="pluginlib, nodelet and rqt read the file there: the classes that it describes are unknown, and every program "
    "that asks for plug-ins of this kind says that the file is missing. In the devel space an uninstalled file is "
    "found, on the robot it is not.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("manifest", "plugin", "install"),
    bad='<export><nodelet plugin="${prefix}/nodelets.xml"/></export>  <!-- and install(TARGETS …) alone -->',
    good='<export><nodelet plugin="${prefix}/nodelets.xml"/></export>  <!-- and install(FILES nodelets.xml …) -->',
    found=found,
)
