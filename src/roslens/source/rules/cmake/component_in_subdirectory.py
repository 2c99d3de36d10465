"""Rule ``cmake.component_in_subdirectory``: components registered where ``ament_package()`` does not see them."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_COMMANDS = ("rclcpp_components_register_node", "rclcpp_components_register_nodes")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each registration in a folder that is added and does not call ``ament_package()`` itself."""
    ends = {one.folder for one in view.cmake.named("ament_package", "ament_auto_package")}
    for one in view.cmake.named(*_COMMANDS):
        if one.folder != view.folder and view.folder in ends and one.folder not in ends and not one.defined:
            message = (
                f"{one.name}() stands in a subdirectory: what it sets is not known to ament_package() of the parent, "
                "which writes the index; expected it in CMakeLists.txt of the package"
            )
            yield one.hit("cmake.component_in_subdirectory", message, one.name)


RULE = PackageRule(
    id="cmake.component_in_subdirectory",
    title="Component registered in a subdirectory",
    finds="`rclcpp_components_register_node(s)` in a CMakeLists.txt that `add_subdirectory` reads, while "
    "`ament_package()` is called by that of the package. A file that is included keeps the scope and is left out.",
    why="The command sets variables in the scope of the subdirectory; `ament_package()` writes the index from those of "
    "its own. The container then knows no component of that name.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("build", "component"),
    bad='# src/CMakeLists.txt, of add_subdirectory(src)\nrclcpp_components_register_nodes(driver "arm::Driver")\n',
    good='# CMakeLists.txt\nadd_subdirectory(src)\nrclcpp_components_register_nodes(driver "arm::Driver")\n'
    "ament_package()\n",
    found=found,
)
