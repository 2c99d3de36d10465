"""Rule ``package.version_disagrees``: setup.py and package.xml state different versions."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.placeholder import has_placeholder


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the version in setup.py where it is another one."""
    call = view.setup_call
    if call is None or not view.package.version:
        return
    for keyword in call.keywords:
        value = keyword.value
        if keyword.arg != "version" or not isinstance(value, ast.Constant) or not isinstance(value.value, str):
            continue
        if value.value != view.package.version and not has_placeholder(f"{value.value} {view.package.version}"):
            message = f"version {value.value!r} here, {view.package.version!r} in package.xml; expected the same"
            at = value.lineno, value.col_offset + 1
            yield Hit("package.version_disagrees", message, *at, context="version", path=view.path("setup.py"))


RULE = PackageRule(
    id="package.version_disagrees",
    title="Versions of setup.py and package.xml differ",
    finds="A `version` in setup.py that is not the `<version>` of package.xml. Keep them equal; "
    "`catkin_prepare_release` raises both.",
    why="What is released, and what `pip`, `importlib.metadata` and `ros2 pkg xml` say on the robot, are two things.",
    profiles=("ros2", "ros1"),
    tags=("manifest", "python"),
    bad='setup(name="arm_teleop", version="0.0.1")  # package.xml: <version>1.2.0</version>',
    good='setup(name="arm_teleop", version="1.2.0")',
    found=found,
)
