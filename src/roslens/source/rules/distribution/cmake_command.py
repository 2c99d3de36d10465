"""Rule ``distribution.cmake_command``: a command of CMake that a distribution of ROS deprecated or removed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.read_changes import Kind, changes_of
from roslens.source.rules.distribution.linked_targets import COMMAND, linked
from roslens.source.rules.distribution.row_hit import row_message
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first call of each command of the tables, with how many others follow."""
    calls: dict[str, list[tuple[Hit, Written]]] = {}
    own = {one.words[0].lower() for one in view.cmake.named("function", "macro") if one.words}
    for one in view.cmake.commands:
        for change in changes_of(Kind.CMAKE).get(one.name, ()):
            # What an `if` asks for, or the package defines, is there where it is called.
            if one.name not in own and not any(f"COMMAND {one.name}" in text for text in one.conditions):
                hit = one.hit("distribution.cmake_command", row_message(change, one.name), one.name)
                calls.setdefault(change.key, []).append((hit, one))
    for key, ((first, _), *others) in calls.items():
        further = f" ({len(others)} more in this package)" if others else ""
        edits = _edits([one for _, one in calls[key]], view)
        yield msgspec.structs.replace(first, change=key, message=f"{first.message}{further}", edits=edits)


def _edits(calls: Sequence[Written], view: PackageView) -> tuple[Edit, ...]:
    """Return what takes the place of all calls of a command; nothing where that of one is not known."""
    if calls[0].name != COMMAND:
        return ()
    edits = [linked(view.read(one.path), one.command.line, one.path) for one in calls]
    known = [one for one in edits if one is not None]
    # What stands in a loop or function is written once, and called more often.
    return tuple(dict.fromkeys(known)) if len(known) == len(edits) else ()


RULE = PackageRule(
    id="distribution.cmake_command",
    title="Command of CMake that the distribution deprecated or removed",
    finds="A call of a CMake command that a distribution of ROS deprecated or does not have any more, by a dated "
    "table: `ament_target_dependencies`, which Lyrical has not. The first call of a package is reported. For which "
    "distributions a package is built, `distro` in roslens.toml or `--distro` says; otherwise files of continuous "
    "integration and containers do. What is deprecated there, or gone in a later distribution where none is known, is "
    "a note.",
    why="CMake ends with «Unknown CMake command», in that distribution only.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("distribution", "build"),
    fix="Writes `target_link_libraries` with the exported targets in place of `ament_target_dependencies`, where the "
    "targets of all packages that are named are known.",
    bad="add_executable(driver src/driver.cpp)\nament_target_dependencies(driver rclcpp)\n",
    good="add_executable(driver src/driver.cpp)\ntarget_link_libraries(driver rclcpp::rclcpp)\n",
    found=found,
)
