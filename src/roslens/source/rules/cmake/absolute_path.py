"""Rule ``cmake.absolute_path``: a build that only works on one machine."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

if TYPE_CHECKING:
    from roslens.source.extract.builds.cmake_syntax import Argument

_PATHS = frozenset({
    "include_directories", "link_directories", "target_include_directories", "target_link_libraries",
    "target_link_directories", "link_libraries", "install", "set", "list", "add_subdirectory", "include",
    "add_library", "add_executable", "set_target_properties", "file", "configure_file",
})  # fmt: skip
_ALONE = re.compile(r"(?:^|[\s\";:=])(/(?:home|Users|root|media|mnt)/[\w.@+-]+(?:/[\w.@+-]*)*)")
_SYSTEM = re.compile(r"^\"?(/(?:opt|usr/local)/[\w.@+-]+(?:/[\w.@+-]*)*)")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each absolute path of one machine that a command uses outside of any condition."""
    for one in view.cmake.commands:
        if one.name not in _PATHS:
            continue
        if _is_asked(one, view):
            continue
        for argument in _used(one):
            if match := _ALONE.search(argument.written):
                message = f"{match[1]!r} is a folder of one machine; expected find_package(), or a path in the package"
                yield one.hit("cmake.absolute_path", message)
                break
            match = _SYSTEM.search(argument.written)
            if match and not one.conditions and one.name not in ("set", "list", "file"):
                message = f"{match[1]!r} is written out; expected find_package() or find_library(), which look for it"
                yield _note(one.hit("cmake.absolute_path", message))
                break


def _used(one: Written) -> Sequence[Argument]:
    """Return the arguments of a command without the text that explains a variable of the cache."""
    given = one.command.arguments
    words = [argument.literal for argument in given]
    return given[: words.index("CACHE") + 2] if "CACHE" in words else given


def _is_asked(one: Written, view: PackageView) -> bool:
    """Return whether CMake asks first if the path is there: around the command, or of the variable that it sets."""
    if any("EXISTS" in condition for condition in one.conditions):
        return True
    if "EXISTS" not in view.cmake.text:
        return False
    name = one.command.arguments[0].literal if one.name == "set" and one.command.arguments else None
    return bool(name) and re.search(rf"EXISTS\s+\"?\$\{{{re.escape(name or '')}[}}/]", view.cmake.text) is not None


def _note(hit: Hit) -> Hit:
    import msgspec

    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)


RULE = PackageRule(
    id="cmake.absolute_path",
    title="Absolute path in a build",
    finds="A path below `/home`, `/root`, `/media` or `/mnt` in a command of CMake, and (as a note) one below "
    "`/opt` or `/usr/local` that is included, linked or installed to without a condition. Look for it with "
    "`find_package`, `find_path` or `find_library`, or take it as an option.",
    why="On any other machine, and in CI, the build fails, or takes a file of the same name that happens to be there.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="include_directories(/home/robot/catkin_ws/devel/include)",
    good="find_package(catkin REQUIRED COMPONENTS robot_msgs)\ninclude_directories(${catkin_INCLUDE_DIRS})",
    found=found,
)
