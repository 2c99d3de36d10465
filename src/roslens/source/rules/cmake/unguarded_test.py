"""Rule ``cmake.unguarded_test``: tests that are built where nobody wants them."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_TESTS = frozenset({
    "ament_add_gtest", "ament_add_gmock", "ament_add_pytest_test", "ament_add_ros_isolated_gtest",
    "ament_lint_auto_find_test_dependencies", "ament_add_gtest_executable", "add_launch_test", "add_rostest",
    "add_rostest_gtest", "catkin_add_gtest", "catkin_add_gmock", "catkin_add_nosetests",
})  # fmt: skip
_FOUND_FOR_TESTS = frozenset({
    "ament_cmake_gtest", "ament_cmake_gmock", "ament_cmake_pytest", "ament_lint_auto", "ament_cmake_lint_cmake",
    "launch_testing_ament_cmake", "rostest",
})  # fmt: skip


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first command for tests that runs also where tests are turned off."""
    for one in view.cmake.commands:
        if one.for_tests or one.defined or one.path != view.cmake.top or not _is_of_tests(one):
            continue
        is_of_catkin = one.name in _OF_CATKIN or one.words[:1] == ("rostest",) or view.ros == {1}
        switch = "CATKIN_ENABLE_TESTING" if is_of_catkin else "BUILD_TESTING"
        message = f"{one.name}({' '.join(one.words[:1])} …) runs without tests too; expected it inside if({switch})"
        yield one.hit("cmake.unguarded_test", message, one.name)
        return


_OF_CATKIN = frozenset({"add_rostest", "add_rostest_gtest", "catkin_add_gtest", "catkin_add_gmock"})


def _is_of_tests(command: Written) -> bool:
    if command.name == "find_package":
        return bool(command.words) and command.words[0] in _FOUND_FOR_TESTS and "REQUIRED" in command.words
    # catkin's own commands exist without testing, except those of rostest.
    return command.name in _TESTS


RULE = PackageRule(
    id="cmake.unguarded_test",
    title="Tests outside of the condition for tests",
    finds="A command that makes tests, or a `REQUIRED` package that only tests need, outside of "
    "`if(BUILD_TESTING)` (catkin: `if(CATKIN_ENABLE_TESTING)`). The first one of a package is reported.",
    why="Builds for a robot leave tests and their dependencies out: `-DBUILD_TESTING=OFF` then ends with a package "
    "or a command that is not found, as it does on the build farms.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("build", "test"),
    bad="find_package(ament_cmake_gtest REQUIRED)\nament_add_gtest(test_driver test/test_driver.cpp)",
    good="if(BUILD_TESTING)\n  find_package(ament_cmake_gtest REQUIRED)\n  ament_add_gtest(test_driver "
    "test/test_driver.cpp)\nendif()",
    found=found,
)
