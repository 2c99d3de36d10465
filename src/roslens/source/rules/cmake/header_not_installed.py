"""Rule ``cmake.header_not_installed``: headers that others are promised and never get."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_BUILDS = ("add_executable", "add_library")
_EXPORTS = ("ament_export_libraries", "ament_export_targets", "ament_export_interfaces", "catkin_package")
_AUTOMATIC = ("ament_auto_package", "autoware_package")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the command that exports the folder of headers, where nothing installs it."""
    cmake = view.cmake
    if cmake.first(*_AUTOMATIC) is not None:
        return
    command = _export(view)
    headers = [path for path in view.by_path if view.inside(path).startswith("include/") and path.endswith(_HEADERS)]
    if command is None or not headers:
        return
    for one in cmake.named("install"):
        kinds = {"DIRECTORY", "FILES", "FILE_SET"} & set(one.words)
        # Generated headers, or a list that is open, may be these.
        if kinds and any("include" in word or "$" in word or "HEADERS" in word for word in one.words):
            return
    is_plugin = cmake.first("pluginlib_export_plugin_description_file") is not None
    is_built_on = any(is_of_build for _, is_of_build in view.around.dependents)
    is_program = cmake.first(*_BUILDS) is not None and cmake.first(*_EXPORTS) is None
    is_read = 2 in view.ros and (is_built_on or not (is_plugin or is_program))
    certainty = None if is_read else Certainty.HEURISTIC
    message = f"folder 'include' ({len(headers)} headers) is exported and installed by nothing"
    hit = command.hit("cmake.header_not_installed", f"{message}; expected install(DIRECTORY include/ …)", "include")
    yield msgspec.structs.replace(hit, certainty=certainty)


_HEADERS = (".h", ".hpp", ".hh", ".hxx")


def _export(view: PackageView) -> Written | None:
    if command := view.cmake.first("ament_export_include_directories"):
        return command if "include" in "".join(command.words) and not command.defined else None
    command = view.cmake.first("catkin_package")
    if command is None or "INCLUDE_DIRS" not in command.words:
        return None
    after = command.words[command.words.index("INCLUDE_DIRS") + 1 :]
    return command if after[:1] == ("include",) else None


RULE = PackageRule(
    id="cmake.header_not_installed",
    title="Headers that are exported and not installed",
    finds="`ament_export_include_directories(include)` or `catkin_package(INCLUDE_DIRS include)` in a package "
    "whose folder `include` no `install` command names. In ROS 1 it is a note: the devel space finds it. So it is "
    "where the package exports plug-ins, which are loaded and not included, or builds what it does not export, and no "
    "package of the workspace is built with it.",
    why="Packages that use it build beside its source and nowhere else: against the installation, or the released "
    "package, the header is missing.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("build", "install"),
    bad="ament_export_include_directories(include)\nament_package()",
    good="install(DIRECTORY include/ DESTINATION "
    "include/${PROJECT_NAME})\nament_export_include_directories(include/${PROJECT_NAME})\nament_package()",
    found=found,
)
