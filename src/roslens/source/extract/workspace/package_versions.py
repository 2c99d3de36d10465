"""For which versions of ROS a package is built: by its manifests, else by what its build asks for."""

from __future__ import annotations

import re
from collections.abc import Iterable

from roslens.model.source import Package
from roslens.source.extract.ir.ros_switch import VERSIONS

_BUILD_TYPES = {"ros1": "catkin", "ros2": "ament_cmake"}
_COMMENT = re.compile(rb"(?m)#.*$")
_CATKIN = re.compile(rb"find_package\s*\(\s*catkin\b|\bcatkin_package\s*\(")
_AMENT = re.compile(rb"find_package\s*\(\s*(?:ament_|rclcpp\b)|\bament_package\s*\(")
_FOUND_CATKIN = re.compile(rb"find_package\s*\(\s*catkin")
_ROS2_ALONE = re.compile(rb"find_package\s*\(\s*ament_|\(\s*rclcpp\b")
_FURTHER = re.compile(r"package[._-]?ros_?([12])\.xml|package\.xml[._-]ros_?([12])", re.IGNORECASE)


def versions_of(package: Package, cmake: bytes = b"", files: Iterable[str] = ()) -> tuple[str, ...]:
    """Return ``ros1``, ``ros2`` or both.

    Args:
        package: by its manifest, whose conditions hold for one version alone.
        cmake: its ``CMakeLists.txt``; empty where it has none.
        files: of the package: a manifest for each version may lie side by side.
    """
    code = _COMMENT.sub(b"", cmake)
    if _CATKIN.search(code) and _AMENT.search(code):
        return VERSIONS
    found = {_single(package, code)}
    types = [one for one in package.exports if one.tag == "build_type"]
    named = [(one.text, one.attributes.get("condition", "")) for one in types]
    named += [(one.name, one.condition) for one in package.dependencies]
    if any("ROS_VERSION" in condition for _, condition in named):
        # What holds under no condition may be left over from another version.
        found |= {"ros1" for name, _ in named if name == "catkin"}
        found |= {"ros2" for name, _ in named if name.startswith("ament_")}
    for path in files:
        further = _FURTHER.fullmatch(path.rpartition("/")[2])
        if further is not None:
            found.add(f"ros{further[1] or further[2]}")
    return tuple(version for version in VERSIONS if version in found)


def _single(package: Package, code: bytes) -> str:
    if package.build_type != "catkin" or any(one.name == "catkin" for one in package.dependencies):
        return "ros1" if package.build_type == "catkin" else "ros2"
    # A manifest without a build type means catkin by REP-149, which is not so where its build asks for ament.
    return "ros2" if not _FOUND_CATKIN.search(code) and _ROS2_ALONE.search(code) else "ros1"


def build_type_for(package: Package, version: str) -> str:
    """Return how a package is built for a version of ROS: ``catkin``, ``ament_cmake`` or another."""
    is_catkin = package.build_type == "catkin"
    return package.build_type if is_catkin == (version == "ros1") else _BUILD_TYPES[version]
