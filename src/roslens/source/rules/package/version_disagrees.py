"""Rule ``package.version_disagrees``: setup.py and package.xml state different versions."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.placeholder import has_placeholder

_PYTHON = ("ament_python_install_package", "catkin_python_setup", "ament_auto_package", "autoware_package")
"""Commands that install what setup.py names."""
_OF_TEMPLATES = frozenset({"0.0.0", "0.0.1"})
"""Versions that `ros2 pkg create` and its like write: nothing was released by them."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the version in setup.py where it is another one."""
    call = view.setup_call
    if call is None or not view.package.version or _runs_nothing(view):
        return
    for keyword in call.keywords:
        value = keyword.value
        if keyword.arg != "version" or not isinstance(value, ast.Constant) or not isinstance(value.value, str):
            continue
        if value.value != view.package.version and not has_placeholder(f"{value.value} {view.package.version}"):
            message = f"version {value.value!r} here, {view.package.version!r} in package.xml; expected the same"
            at = value.lineno, value.col_offset + 1
            written_by_template = not _OF_TEMPLATES.isdisjoint((value.value, view.package.version))
            yield Hit(
                "package.version_disagrees",
                message,
                *at,
                context="version",
                path=view.path("setup.py"),
                certainty=Certainty.HEURISTIC if written_by_template else None,
            )


def _runs_nothing(view: PackageView) -> bool:
    """Return whether CMake builds the package and nothing there asks for its setup.py."""
    cmake = view.cmake
    is_built = view.package.build_type != "ament_python" and cmake.exists
    return is_built and cmake.first(*_PYTHON) is None and not any("setup.py" in one.text for one in cmake.commands)


RULE = PackageRule(
    id="package.version_disagrees",
    title="Versions of setup.py and package.xml differ",
    finds="A `version` in setup.py that is not the `<version>` of package.xml. Keep them equal; "
    "`catkin_prepare_release` raises both. A setup.py that the package's CMakeLists.txt does not use is left out, and "
    "where one of them is what a template wrote it is a note.",
    why="What is released, and what `pip`, `importlib.metadata` and `ros2 pkg xml` say on the robot, are two things.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest", "python"),
    bad='setup(name="arm_teleop", version="0.0.1")  # package.xml: <version>1.2.0</version>',
    good='setup(name="arm_teleop", version="1.2.0")',
    found=found,
)
