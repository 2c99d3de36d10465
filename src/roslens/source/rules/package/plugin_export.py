"""Rule ``package.plugin_export``: a description of plug-ins that no package exports."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.source import Language, Role, SourceFile
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_EXPORTS = frozenset({"plugin", "plugins", "pluginlib", "resource", "auto"})
"""Words in the names of commands that export descriptions: ``ament_index_register_resource`` and those of projects."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each description of plug-ins whose name stands neither in package.xml nor in CMake."""
    candidates = [one for one in view.of_language(Language.XML, roles=(Role.OWN,)) if _is_description(view, one)]
    if not candidates:
        return
    manifest = view.read(view.package.manifest.path).decode("utf-8", "replace")
    said = manifest + view.cmake.text + view.read(view.path("setup.py")).decode("utf-8", "replace")
    if "GLOB" in said:
        return
    installs_only = _installs_only(view, manifest)
    for one in candidates:
        name = one.path.rpartition("/")[2]
        if installs_only or (name not in said and name.rpartition(".")[0] not in said):
            how = (
                "pluginlib_export_plugin_description_file()"
                if 2 in view.ros
                else f'plugin="${{prefix}}/{name}" below <export>'
            )
            message = f"{name!r} describes plug-ins and is exported by nothing; expected {how}"
            certainty = None if installs_only else Certainty.HEURISTIC
            yield Hit("package.plugin_export", message, 1, context=name, path=one.path, certainty=certainty)


def _installs_only(view: PackageView, manifest: str) -> bool:
    """Return whether a build by ament_cmake could export a description, and exports none by any command."""
    if view.package.build_type != "ament_cmake" or view.ros != {2} or "plugin=" in manifest:
        return False
    exporting = [one for one in view.cmake.commands if _EXPORTS & set(one.name.split("_"))]
    return view.cmake.first("ament_package") is not None and not exporting


def _is_description(view: PackageView, file: SourceFile) -> bool:
    inside = view.inside(file.path)
    if inside.startswith("test") or "/test" in inside:
        return False
    content = view.read(file.path)
    return b"<library" in content and b"base_class_type" in content


RULE = PackageRule(
    id="package.plugin_export",
    title="Description of plug-ins that nothing exports",
    finds="An XML file that describes plug-ins (`<library>` with `base_class_type`) and whose name stands neither "
    "in package.xml, CMakeLists.txt nor setup.py: a note. Where the build of a package for ROS 2 exports no "
    "description at all and installs the file only, it is a warning.",
    why="pluginlib finds descriptions by what packages export: the classes are built, installed and unknown to the "
    "robot.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("plugin",),
    bad='<library path="driver"><class type="arm::Driver" base_class_type="arm::Base"/></library>',
    good='<library path="driver"><class type="arm::Driver" base_class_type="arm::Base"/></library>\n<!-- '
    'package.xml: <export><arm plugin="${prefix}/plugins.xml"/></export> -->',
    found=found,
)
