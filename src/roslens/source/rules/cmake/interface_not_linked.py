"""Rule ``cmake.interface_not_linked``: a target uses the interfaces of its own package and is not linked with them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_MAKES = ("add_executable", "add_library")
_LINKS = (
    "target_link_libraries",
    "ament_target_dependencies",
    "rosidl_target_interfaces",
    "target_include_directories",
)
_AUTOMATIC = ("ament_auto_find_build_dependencies", "link_libraries", "include_directories", "autoware_package")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each target with a source that includes an interface of the package, and no word of these in its links."""
    cmake = view.cmake
    generated = cmake.first("rosidl_generate_interfaces")
    if generated is None or generated.defined or cmake.first(*_AUTOMATIC) is not None:
        return
    name = view.package.name
    included = re.compile(rf"[<\"]{re.escape(name)}/(?:msg|srv|action)/[^>\"]+[>\"]")
    for one in cmake.named(*_MAKES):
        if one.defined or not one.words or "$" in one.words[0] or _is_linked(one.words[0], view):
            continue
        if include := _include(one, view, included):
            message = (
                f"target {one.words[0]!r} includes {include} and is not linked with the interfaces of this package; "
                "expected rosidl_get_typesupport_target() and target_link_libraries() with what it sets"
            )
            yield one.hit("cmake.interface_not_linked", message, one.words[0])


def _is_linked(target: str, view: PackageView) -> bool:
    """Whether a command that links a target names the interfaces, or may name them by a variable or another target."""
    own = {one.words[0] for one in view.cmake.named("add_library") if one.words}
    for one in view.cmake.named(*_LINKS):
        if one.words[:1] != (target,):
            continue
        for word in one.words[1:]:
            open_ = "$" in word and not word.endswith("_TARGETS}")
            if open_ or "typesupport" in word or "rosidl" in word or word in own or word == view.package.name:
                return True
    return any(one.words[:1] and "$" in one.words[0] for one in view.cmake.named(*_LINKS))


def _include(made: Written, view: PackageView, included: re.Pattern[str]) -> str:
    for word in made.words[1:]:
        path = view.cmake.inside(word, made)
        facts = view.facts.get(path) if path else None
        for written, _ in facts.includes if facts is not None else ():
            if included.match(written):
                return written
    return ""


RULE = PackageRule(
    id="cmake.interface_not_linked",
    title="Target that is not linked with the interfaces of its own package",
    finds="A target with a source that includes a message, service or action of its own package, which "
    "`rosidl_generate_interfaces` makes, while no command that links the target names them: "
    "`rosidl_get_typesupport_target` and `target_link_libraries`, or `rosidl_target_interfaces`. Targets linked with a "
    "variable or another library of the package are left out.",
    why="The generated headers are in the folder of the build, which only the typesupport target knows: the compiler "
    "does not find them, or finds those of an earlier installation.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("build", "interfaces"),
    bad="rosidl_generate_interfaces(${PROJECT_NAME} msg/State.msg)\nadd_executable(driver src/driver.cpp)\n"
    "target_link_libraries(driver rclcpp::rclcpp)\n",
    good="rosidl_generate_interfaces(${PROJECT_NAME} msg/State.msg)\nadd_executable(driver src/driver.cpp)\n"
    "rosidl_get_typesupport_target(interfaces ${PROJECT_NAME} rosidl_typesupport_cpp)\n"
    "target_link_libraries(driver rclcpp::rclcpp ${interfaces})\n",
    found=found,
)
