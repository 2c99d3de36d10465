"""Rule ``cmake.message_order``: sources that may be compiled before the headers of their messages exist."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_LONGEST_CHAIN = 4
"""Of targets that link each other: what is linked is built before, and waits for all of them."""
_GENERATES = ("generate_messages", "generate_dynamic_reconfigure_options")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each target of catkin that includes generated headers of its package and waits for none of them."""
    cmake = view.cmake
    makes = cmake.first(*_GENERATES)
    if 1 not in view.ros or makes is None:
        return
    name = view.package.name
    made = {
        f"{name}/{path.rpartition('/')[2].rpartition('.')[0]}{end}"
        for path in view.listing
        for folder, ends in _FOLDERS.items()
        if path.startswith(folder) and path.endswith(_ENDINGS[folder])
        for end in ends
    }
    waits = {one.words[0] for one in cmake.named("add_dependencies") if one.words}
    if any("$" in word for word in waits):
        return
    for _ in range(_LONGEST_CHAIN):
        links = [one for one in cmake.named("target_link_libraries") if waits & set(one.words[1:])]
        waits |= {one.words[0] for one in links}
    for one in cmake.named("add_executable", "add_library", "cuda_add_library"):
        if one.defined or one.for_tests or not one.words or one.words[0] in waits or "$" in one.words[0]:
            continue
        # In the arm for ROS 2 of a package for both, the target of the messages is linked.
        if _excludes(one.conditions, makes.conditions):
            continue
        if (first := _generated(one, made, view)) is not None:
            message = f"target {one.words[0]!r} includes {first!r}, which is generated, and does not wait for it"
            yield one.hit("cmake.message_order", f"{message}; expected add_dependencies()", one.words[0])


def _excludes(some: tuple[str, ...], others: tuple[str, ...]) -> bool:
    """Return whether what stands under some conditions never runs together with what stands under others."""
    return any(f"NOT ({one})" in others for one in some) or any(f"NOT ({one})" in some for one in others)


_FOLDERS = {"msg/": (".h",), "srv/": (".h", "Request.h", "Response.h"), "cfg/": ("Config.h",), "action/": ("Action.h",)}
_ENDINGS = {"msg/": ".msg", "srv/": ".srv", "cfg/": ".cfg", "action/": ".action"}


def _generated(command: Written, made: set[str], view: PackageView) -> str | None:
    waiting = [view.cmake.inside(word, command) for word in command.words[1:]]
    seen: set[str] = set()
    while waiting:
        path = waiting.pop()
        if path is None or path in seen or path not in view.facts:
            continue
        seen.add(path)
        for written, _ in view.facts[path].includes:
            header = written.strip('<>"')
            if header in made:
                return header
            waiting.append(view.path(f"include/{header}"))
    return None


RULE = PackageRule(
    id="cmake.message_order",
    title="Target that does not wait for generated headers",
    finds="In a catkin package that generates messages, services, actions or reconfigure options: a target whose "
    "sources include one of these headers, and that no `add_dependencies` makes wait. Add `add_dependencies(TARGET "
    "${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})`.",
    why="Whether the header exists when the source is compiled is chance: the build fails on a machine with more "
    "processors, or in CI, or takes the header of an older installation.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("build",),
    clauses=("catkin_lint missing_add_dependencies",),
    bad="add_executable(driver src/driver.cpp)  # includes arm_driver/State.h",
    good="add_executable(driver src/driver.cpp)\nadd_dependencies(driver ${${PROJECT_NAME}_EXPORTED_TARGETS})",
    found=found,
)
