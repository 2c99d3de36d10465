"""Rule ``cmake.missing_path``: a command installs, generates or exports what is not there."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from posixpath import basename, dirname

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import CmakeView, Written

_ID = "cmake.missing_path"
_WORDS = frozenset({"FILES", "PROGRAMS", "DIRECTORY"})
_ENDS = frozenset({
    "DESTINATION", "TYPE", "PERMISSIONS", "FILE_PERMISSIONS", "DIRECTORY_PERMISSIONS", "CONFIGURATIONS", "COMPONENT",
    "RENAME", "OPTIONAL", "EXCLUDE_FROM_ALL", "MESSAGE_NEVER", "USE_SOURCE_PERMISSIONS", "FILES_MATCHING", "PATTERN",
    "REGEX", "EXCLUDE", "DEPENDENCIES", "DIRECTORY", "NOINSTALL", "ARGS",
})  # fmt: skip
"""Words after which no path follows; ``DIRECTORY`` of ``add_message_files`` is one too."""
_DEFINING = {"add_message_files": "msg", "add_service_files": "srv", "add_action_files": "action"}
_ENDINGS = (".msg", ".srv", ".action", ".idl")
_SETTING = frozenset({"set", "list", "foreach"})
_READING = frozenset({
    "install", "catkin_install_python", "include_directories", "target_include_directories", "catkin_package",
    "ament_export_include_directories", "rosidl_generate_interfaces", "add_message_files", "add_service_files",
    "add_action_files", "roslaunch_add_file_check", "message", "if",
})  # fmt: skip
"""Commands that make no file."""
_VARIABLE = re.compile(r"\$\{(\w+)\}")
_FOLDERS = re.compile(r"(?:CMAKE_CURRENT_|CMAKE_|PROJECT_|\w+_)(?:SOURCE|LIST)_DIR")
_PROJECT = ("PROJECT_NAME", "CMAKE_PROJECT_NAME")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each path that a command needs, that is written out and neither there nor made by a command."""
    cmake = view.cmake
    for one in cmake.commands:
        if one.defined or one.for_tests or "OPTIONAL" in one.words:
            continue
        for word in dict.fromkeys(_needed(one, cmake)):
            path = cmake.inside(word, one) if "<" not in word else None
            if path is not None and not _is_there(path, view) and not _is_made(path, one, cmake):
                yield _hit(one, word, path, view)


def _needed(one: Written, cmake: CmakeView) -> Iterator[str]:
    """Yield the paths below the sources that a command cannot do without."""
    words = list(_known(one, cmake))
    match one.name:
        case "install" | "catkin_install_python" if words and words[0] in _WORDS:
            yield from _until_end(words[1:])
        case "rosidl_generate_interfaces":
            yield from (word for word in _until_end(words[1:]) if word.endswith(_ENDINGS))
        case "generate_dynamic_reconfigure_options":
            yield from _until_end(words)
        case "catkin_package":
            yield from _until_end("ARGS" if word.isupper() else word for word in _behind("INCLUDE_DIRS", words))
        case name if name in _DEFINING:
            folder = next(iter(_behind("DIRECTORY", words)), _DEFINING[name])
            yield from (f"{folder}/{word}" for word in _until_end(_behind("FILES", words)))


def _behind(word: str, words: list[str]) -> list[str]:
    return words[words.index(word) + 1 :] if word in words else []


def _until_end(words: Iterable[str]) -> Iterator[str]:
    for word in words:
        if word in _ENDS:
            return
        if word and word not in _WORDS:
            yield word


def _known(one: Written, cmake: CmakeView) -> Iterator[str]:
    """Yield the words of a command that can have one meaning only; the others are left out."""
    for argument in one.command.arguments:
        if argument.kind == "paren":
            continue
        written = argument.literal if argument.literal is not None else argument.written.strip('"')
        for word in _meanings(written, cmake):
            yield from (word.split(";") if argument.kind == "bare" else (word,))


def _meanings(written: str, cmake: CmakeView) -> Iterator[str]:
    """Yield the words that an argument stands for; none where that is open."""
    for name in _PROJECT:
        written = written.replace(f"${{{name}}}", cmake.project() or f"${{{name}}}")
    lists = [name for name in _VARIABLE.findall(written) if not _FOLDERS.fullmatch(name)]
    if not lists:
        yield written
    elif len(lists) == 1 and lists[0] not in _PROJECT:
        yield from (written.replace(f"${{{lists[0]}}}", value) for value in _values(lists[0], cmake))


def _values(name: str, cmake: CmakeView) -> tuple[str, ...]:
    """Return what a variable is made of where every command that says it counts always; nothing otherwise."""
    if not all(_is_plain(name, one, cmake) for one in cmake.commands):
        return ()
    values = cmake.values(name)
    return values if not any("$" in value or value in ("IN", "LISTS", "ITEMS") for value in values) else ()


def _is_plain(name: str, one: Written, cmake: CmakeView) -> bool:
    """Return whether a command leaves a variable alone, or gives it words that are written out."""
    if name not in one.words[:3] or one.name not in _SETTING:
        return one.name in _READING or all(argument.literal != name for argument in one.command.arguments)
    if one.conditions or one.defined or one.words[0] in ("FILTER", "TRANSFORM", "REMOVE_ITEM"):
        return False
    return one.name != "foreach" or not ("RANGE" in one.words or any(cmake.values(word) for word in one.words[1:]))


def _is_there(path: str, view: PackageView) -> bool:
    """Return whether something is at a path, or may come there: a submodule that was not cloned is an empty folder."""
    if path.startswith("..") or (view.folder and not f"{path}/".startswith(f"{view.folder}/")):
        return True
    if view.exists(path):
        return True
    folder = dirname(path)
    below = f"{view.inside(folder)}/"
    return (
        folder not in ("", view.folder)
        and view.exists(folder)
        and not any(one.startswith(below) for one in view.listing)
    )


def _is_made(path: str, one: Written, cmake: CmakeView) -> bool:
    """Return whether a command may make a path, or ends the file before it is asked for."""
    name = basename(path)
    for other in cmake.commands:
        if other is one:
            return False
        if other.name == "return" and not other.defined:
            return True
        if other.name in _READING or other.name in _SETTING:
            continue
        if any(name in word for word in other.words):
            return True
    return False


def _hit(one: Written, word: str, path: str, view: PackageView) -> Hit:
    what = "folder" if "DIRECTORY" in one.words[:1] or one.name == "catkin_package" else "file"
    pattern = any(sign in word for sign in "*?[")
    advice = (
        "; it takes no patterns: expected names, or DIRECTORY" if pattern else f"; expected a {what} of the package"
    )
    message = f"{what} {word!r} does not exist, and {one.name}() needs it{advice}"
    hit = one.hit(_ID, message, path)
    if one.conditions:
        return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)
    # catkin_make installs nothing unless it is told to; colcon always does.
    is_installed = one.name in ("install", "catkin_install_python")
    return msgspec.structs.replace(hit, certainty=Certainty.LIKELY) if is_installed and 2 not in view.ros else hit


RULE = PackageRule(
    id=_ID,
    title="File or folder that CMake needs and that is not there",
    finds="A file or folder that `install(FILES …)`, `install(PROGRAMS …)`, `install(DIRECTORY …)`, "
    "`catkin_install_python`, `catkin_package(INCLUDE_DIRS …)`, or a generator of messages or of dynamic parameters "
    "names, and that neither is in the package nor is made by a command; a pattern is one too, as `install(FILES)` "
    "takes none. Folders that are empty are in no repository. Inside of a condition it is a note.",
    why="CMake stops, or the install step does: colcon reports the package as failed, and nothing that depends on it "
    "is built.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("build", "install"),
    bad="install(DIRECTORY launch rvis DESTINATION share/${PROJECT_NAME})  # the folder is rviz",
    good="install(DIRECTORY launch rviz DESTINATION share/${PROJECT_NAME})",
    found=found,
)
