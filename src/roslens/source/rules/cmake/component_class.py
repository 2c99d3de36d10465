"""Rule ``cmake.component_class``: components that the build registers and no source does, or the other way."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written
from roslens.source.rules.views.registered_classes import same_class

_AUTOMATIC = ("ament_auto_add_library", "autoware_ament_auto_add_library", "cuda_add_library")
_SOURCE = re.compile(r"\.(?:c|cc|cpp|cxx|cu)$")
_REGISTERS = re.compile(
    rb"#\s*include\s*[<\"][^>\"]*\.(?:c|cc|cpp|cxx|inc|inl|ipp|def)[>\"]|\b[A-Z]\w*REGISTER\w*\s*\("
)
"""What may register a class: a macro, or a piece of source that is included."""
_COMMENT = re.compile(rb"//[^\n]*|/\*.*?\*/", re.DOTALL)
_COMMANDS = ("rclcpp_components_register_node", "rclcpp_components_register_nodes")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each class that CMakeLists.txt registers and no source does, and each one of a source that it does not."""
    commands = [one for one in view.cmake.named(*_COMMANDS) if not one.defined]
    if not commands and "rclcpp_components" not in view.cmake.text:
        return
    registered, complete = view.registered
    components = [one for one in registered if not one.base]
    built = [(one, name) for one in commands for name in _classes(one)]
    if any("$" in name for _, name in built) or any(one.defined for one in view.cmake.named(*_COMMANDS)):
        return
    if complete:
        yield from _unregistered(built, [one.name for one in components], view)
    for each in components:
        # What is not ported yet lies there and is built by nothing.
        if view.cmake.may_build(each.path) and not _is_built(each.name, [name for _, name in built], view.cmake.text):
            message = (
                f"component {each.name!r} is registered by no command of CMakeLists.txt; expected {_COMMANDS[0]}()"
            )
            yield Hit("cmake.component_class", message, each.line, context=each.name, path=each.path)


def _unregistered(built: Iterable[tuple[Written, str]], registered: Sequence[str], view: PackageView) -> Iterator[Hit]:
    for command, name in built:
        if any(same_class(name, each) for each in registered) or not (registered or _is_all_known(command, view)):
            continue
        message = f"no source registers {name!r}; expected RCLCPP_COMPONENTS_REGISTER_NODE({name})"
        yield command.hit("cmake.component_class", message, name)


def _is_all_known(command: Written, view: PackageView) -> bool:
    """Return whether all sources of the library of a command are there, and no macro of another name registers one."""
    library = next(
        (one for one in view.cmake.named("add_library", *_AUTOMATIC) if one.words[:1] == command.words[:1]), None
    )
    if library is None or not command.words:
        return False
    paths = [view.cmake.inside(word, library) for word in library.words[1:] if _SOURCE.search(word)]
    if not paths or any(path is None or path not in view.by_path for path in paths):
        return False
    texts = [view.read(path) for path in paths if path is not None]
    return not any(_REGISTERS.search(_COMMENT.sub(b"", text)) for text in texts)


def _is_built(name: str, built: Iterable[str], text: str) -> bool:
    """Whether a class is among those that commands register, or named anywhere in the text of CMakeLists.txt."""
    last = name.rpartition("::")[2]
    return any(same_class(one, name) for one in built) or re.search(rf"\b{re.escape(last)}\b", text) is not None


def _classes(command: Written) -> Iterator[str]:
    words = list(command.words[1:])
    if command.name == _COMMANDS[1]:
        yield from (word for word in words if "::" in word or (word[:1].isupper() and not word.isupper()))
    elif "PLUGIN" in words[:-1]:
        yield words[words.index("PLUGIN") + 1].strip('"')


RULE = PackageRule(
    id="cmake.component_class",
    title="Component registered on one side only",
    finds="A class that `rclcpp_components_register_node` names and no source registers with "
    "`RCLCPP_COMPONENTS_REGISTER_NODE`, and a class of a source that no command names.",
    why="The container finds no factory for it, or `ros2 component types` does not list it: loading fails when the "
    "robot starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("build", "plugin"),
    bad='rclcpp_components_register_node(driver PLUGIN "arm::Drivr" EXECUTABLE driver_node)',
    good='rclcpp_components_register_node(driver PLUGIN "arm::Driver" EXECUTABLE driver_node)',
    found=found,
)
