"""Rule ``package.interface_refused``: a message, service or action that the generator of ROS refuses."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.source import Language, Role, SourceFile
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ID = "package.interface_refused"
_LANGUAGES = (Language.MSG, Language.SRV, Language.ACTION)
_GENERATORS = {2: ("rosidl_generate_interfaces",), 1: ("add_message_files", "add_service_files", "add_action_files")}
_FILE_NAME = re.compile(r"[A-Z][A-Za-z0-9]*")
"""VALID_MESSAGE_NAME_PATTERN of rosidl_adapter."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each line of a definition that rosidl or genmsg refuses, in a package that generates it."""
    generations = [
        generation
        for generation, commands in _GENERATORS.items()
        if generation in view.ros and any(not one.for_tests for one in view.cmake.named(*commands))
    ]
    if len(generations) != 1:
        # A package for both has a definition for each, or none that both refuse: which is read is decided elsewhere.
        return
    for file in view.of_language(*_LANGUAGES, roles=(Role.OWN,)):
        if _is_generated(file, view):
            yield from _refused(file, generations[0], view)


def _is_generated(file: SourceFile, view: PackageView) -> bool:
    """Return whether CMake names a definition; one that is found by a pattern may be left out."""
    return re.search(rf"(?<![\w-]){re.escape(file.path.rpartition('/')[2])}\b", view.cmake.text) is not None


def _refused(file: SourceFile, generation: int, view: PackageView) -> Iterator[Hit]:
    from roslens.source.extract.interfaces.interface_file import read_interface

    stem = file.path.rpartition("/")[2].rpartition(".")[0]
    generator = "rosidl" if generation == 2 else "genmsg"
    if generation == 2 and not _FILE_NAME.fullmatch(stem):
        message = f"rosidl refuses the name {stem!r} of a definition; expected a capital first, letters and digits"
        yield Hit(_ID, message, 1, context=stem, path=file.path)
    _, failures = read_interface(view.read(file.path), file.path, view.package.name, generation)
    for failure in failures:
        place = failure.location
        line, column = (place.line, place.column) if place is not None else (1, 1)
        message = f"{generator} refuses {failure.what}" + (f"; expected {failure.expected}" if failure.expected else "")
        yield Hit(_ID, message, line, column, context=failure.what, path=file.path)


RULE = PackageRule(
    id=_ID,
    title="Definition of a message that is refused",
    finds="A line of a `.msg`, `.srv` or `.action` that CMakeLists.txt names and that rosidl (genmsg in ROS 1) does "
    "not understand: a name of a field with capitals, two underscores in a row or one at its end, a constant in lower "
    "case, a type that is none, a value that does not fit its type, a name that is used twice, a wrong number of "
    "`---`; and in ROS 2 a file whose name is not in CamelCase.",
    why="The build of the package ends there, and everything that depends on it is not built.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("build", "interface"),
    bad="float64 front_Right",
    good="float64 front_right",
    found=found,
)
