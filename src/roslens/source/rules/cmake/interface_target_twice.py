"""Rule ``cmake.interface_target_twice``: a Python package of the name under which interfaces install theirs."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each installation of a Python package of the name of generated interfaces."""
    generated = {
        one.words[0]
        for one in view.cmake.named("rosidl_generate_interfaces")
        if one.words and not one.conditions and "$" not in one.words[0]
    }
    for one in view.cmake.named("ament_python_install_package"):
        if one.words[:1] and one.words[0] in generated and not one.conditions and not one.defined:
            name = one.words[0]
            message = (
                f"rosidl_generate_interfaces({name}) installs a Python package {name!r} already: the target exists "
                "twice; expected another name, or a package of its own for the interfaces"
            )
            yield one.hit("cmake.interface_target_twice", message, name)


RULE = PackageRule(
    id="cmake.interface_target_twice",
    title="Python package with the name of the interfaces",
    finds="`ament_python_install_package(NAME)` beside `rosidl_generate_interfaces(NAME)` in one package, outside of "
    "conditions: the generated interfaces install a Python package of that name, too.",
    why="CMake ends with «add_custom_target cannot create target … because another target with the same name already "
    "exists»; where it does not, one of the two packages hides the other.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("build", "python"),
    bad="rosidl_generate_interfaces(arm msg/State.msg)\nament_python_install_package(arm)\n",
    good="rosidl_generate_interfaces(arm msg/State.msg)\nament_python_install_package(arm_tools)\n",
    found=found,
)
