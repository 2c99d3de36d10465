"""Rule ``cmake.package_end_missing``: a package whose CMakeLists.txt does not register it."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ENDS = {"ament_cmake": "ament_package", "catkin": "catkin_package"}
_OTHERS = frozenset({"find_package", "ament_python_install_package", "ament_find_gtest"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the project of a package whose build never calls the command that registers it."""
    stated = [one.text for one in view.package.exports if one.tag == "build_type"]
    end = _ENDS.get(view.package.build_type, "")
    project = view.cmake.first("project")
    if not end or len(stated) > 1 or project is None or view.ros == {1, 2}:
        return
    if any(_may_end(one.name, view) for one in view.cmake.commands):
        return
    name = "ament_cmake" if end == "ament_package" else "catkin"
    # Without the build system, the file may be for another one, or for documentation alone.
    if not any(name in "".join(one.words[:1]) for one in view.cmake.named("find_package")):
        return
    message = f"nothing calls {end}(), which registers the package; expected it as the last command"
    yield project.hit("cmake.package_end_missing", message, end)


def _may_end(name: str, view: PackageView) -> bool:
    """Return whether a command registers the package, or is one of the package's own or of a library that may."""
    own = name.endswith(("_package", "_metapackage")) and name not in _OTHERS
    return own or (name == "include" and any("$" in word for one in view.cmake.named("include") for word in one.words))


RULE = PackageRule(
    id="cmake.package_end_missing",
    title="Package that its build does not register",
    finds="A package with the build type `ament_cmake` or `catkin` whose CMakeLists.txt finds that build system and "
    "never calls `ament_package()` or `catkin_package()`. A command of another name that ends with `_package`, as "
    "projects define them, counts as one, and so does a file that is included by a variable.",
    why="The package is built and unknown afterwards: without its entry in the index, package.xml and environment, "
    "`ros2 run`, launch files and `find_package` do not find it.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="project(arm)\nfind_package(ament_cmake REQUIRED)\nadd_executable(driver src/driver.cpp)\n",
    good="project(arm)\nfind_package(ament_cmake REQUIRED)\nadd_executable(driver src/driver.cpp)\nament_package()\n",
    found=found,
)
