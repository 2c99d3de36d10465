"""Rule ``package.build_type``: the manifest names another build system than the package has."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.source import Export
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_AMENT = ("ament_package", "ament_auto_package")
_CATKIN = ("catkin_package", "catkin_metapackage")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the build type that is active and that the files of the package do not have."""
    stated = [one for one in view.package.exports if one.tag == "build_type"]
    if not stated:
        yield from _unstated(view)
    # More than one is for the other ROS, and so may be any part of the package.
    if len(stated) != 1 or not stated[0].active:
        return
    (one,) = stated
    has_setup = "setup.py" in view.listing
    if one.text == "ament_python" and not has_setup:
        yield _hit(one, "but there is no setup.py")
    elif one.text in ("ament_cmake", "catkin", "cmake") and not view.cmake.exists and not view.exists(view.cmake.top):
        yield _hit(one, "but there is no CMakeLists.txt" + (", and a setup.py" if has_setup else ""))
    elif command := _of_the_other(view, one.text):
        yield _hit(one, f"but CMakeLists.txt calls {command.name}()")


def _unstated(view: PackageView) -> Iterator[Hit]:
    """Yield the manifest without a build type of a package for ament, which colcon takes for one of catkin."""
    command = view.cmake.first(*_AMENT)
    path = view.package.manifest.path
    if command is None or view.cmake.first(*_CATKIN) is not None or command.conditions or not path:
        return
    if any(one.name == "catkin" for one in view.package.dependencies):
        return
    message = (
        "there is no build type, so that colcon takes the package for one of catkin, but CMakeLists.txt calls "
        f"{command.name}(); expected <export><build_type>ament_cmake</build_type></export>"
    )
    yield Hit("package.build_type", message, 1, context="build_type", path=path, certainty=Certainty.LIKELY)


def _of_the_other(view: PackageView, kind: str) -> Written | None:
    ends = {"ament_cmake": (_CATKIN, _AMENT), "catkin": (_AMENT, _CATKIN)}.get(kind)
    if ends is None or view.cmake.first(*ends[1]) is not None:
        return None
    return view.cmake.first(*ends[0])


def _hit(stated: Export, what: str) -> Hit:
    where = stated.location
    message = f"the build type is {stated.text!r}, {what}; expected the build system that the package has"
    return Hit("package.build_type", message, where.line, where.column, context=stated.text, path=where.path)


RULE = PackageRule(
    id="package.build_type",
    title="Build type that the package does not have",
    finds="A `<build_type>` whose build system has no file in the package (`ament_python` without setup.py, "
    "`ament_cmake` without CMakeLists.txt), or whose CMakeLists.txt is for the other ROS, and, as a "
    "warning, none at all beside a CMakeLists.txt for ament. Packages with a build "
    "type for each ROS are left out.",
    why="colcon chooses by it how to build: the build fails, or installs nothing.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest", "build"),
    bad="<export><build_type>ament_cmake</build_type></export>  <!-- only setup.py -->",
    good="<export><build_type>ament_python</build_type></export>",
    found=found,
)
