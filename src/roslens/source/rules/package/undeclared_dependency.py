"""Rule ``package.undeclared_dependency``: the package uses one that its manifest does not declare."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.finding import Severity
from roslens.source.rules.dependency_uses import BUILD, RUN, TEST, Use
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.system_packages import KEYS, NEEDS_NO_KEY, brings, looks_like_ros_package, stands_for

_WHAT = {
    "#include": "headers are included of packages",
    "import": "modules are imported of packages",
    "launch": "launch files need packages",
}
_TAGS = {BUILD: "<depend>", RUN: "<exec_depend>", TEST: "<test_depend>"}


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each package that is found and not declared, and at once those that are included, or imported."""
    declared = {one.name for one in (*view.package.dependencies, *view.package.member_of_groups)}
    told: set[str] = set()
    gathered: dict[str, dict[str, Use]] = {"#include": {}, "import": {}, "launch": {}}
    for use in view.uses:
        if use.name in told or not _expected(use, view) or any(_is_said(key, use) for key in declared):
            continue
        told.add(use.name)
        how = use.how.partition(" ")[0]
        if how in gathered:
            gathered[how][use.name] = use
            continue
        message = f"{use.how}: package.xml does not declare {use.name!r}; expected {_TAGS[use.when]}"
        yield Hit("package.undeclared_dependency", message, use.line, context=use.name, path=use.path)
    for how, uses in gathered.items():
        if uses:
            yield _together(how, list(uses.values()))


def _together(how: str, uses: list[Use]) -> Hit:
    first = uses[0]
    names = ", ".join(repr(use.name) for use in uses)
    tags = " and ".join(dict.fromkeys(_TAGS[use.when] for use in uses))
    message = f"{_WHAT[how]} that package.xml does not declare: {names}; expected {tags}"
    # What is included was found in the build: another dependency brings it.
    severity = Severity.NOTE if how == "#include" else None
    return Hit("package.undeclared_dependency", message, first.line, context=how, path=first.path, severity=severity)


def _is_said(key: str, use: Use) -> bool:
    # What is built needs the package itself, because CMake looks for it.
    return stands_for(key, use.name) or (use.when == RUN and brings(key, use.name))


def _expected(use: Use, view: PackageView) -> bool:
    name = use.name
    if not use.required or name in NEEDS_NO_KEY or name == view.package.name:
        return False
    if any(one.endswith((f"Find{name}.cmake", f"{name}-config.cmake", f"{name}Config.cmake")) for one in view.listing):
        return False
    if name.startswith("ament_cmake"):
        return use.when == TEST and name.removeprefix("ament_cmake_") in ("gtest", "gmock", "pytest")
    return use.how.startswith("launch") or name in KEYS or looks_like_ros_package(name)


RULE = PackageRule(
    id="package.undeclared_dependency",
    title="Package used and not declared",
    finds="A package that CMakeLists.txt finds, that a launch file finds or starts nodes of, or, of ROS, that "
    "sources include or import, and of which package.xml says nothing. What is imported is one finding for a "
    "package, what launch files need another, what is included one note. Libraries are known by the keys of "
    "rosdep; modules of CMake need none.",
    why="rosdep does not install it, colcon and catkin may build this package before it, and a build of only this "
    "package fails on the next machine; today it works because another package happens to bring it.",
    profiles=("ros2", "ros1"),
    tags=("manifest", "dependency"),
    clauses=("catkin_lint missing_depend",),
    bad="find_package(tf2_ros REQUIRED)  # package.xml: nothing of tf2_ros",
    good="<depend>tf2_ros</depend>",
    found=found,
)
