"""Rule ``package.interface_package``: a definition uses a message of a package that the generator is not given."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from posixpath import basename
from typing import TYPE_CHECKING

from roslens.model.source import Language, Role, SourceFile
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import CmakeView, Written

if TYPE_CHECKING:
    from roslens.source.extract.interfaces.interface import FieldType

_ID = "package.interface_package"
_LANGUAGES = (Language.MSG, Language.SRV, Language.ACTION)
_ENDINGS = (".msg", ".srv", ".action", ".idl")
_BRINGS: dict[str, tuple[str, ...]] = {
    "builtin_interfaces": (), "unique_identifier_msgs": (), "lifecycle_msgs": (), "std_srvs": (), "uuid_msgs": (),
    "service_msgs": ("builtin_interfaces",), "std_msgs": ("builtin_interfaces",),
    "action_msgs": ("builtin_interfaces", "unique_identifier_msgs", "service_msgs"),
    "actionlib_msgs": ("std_msgs",), "geometry_msgs": ("std_msgs",), "shape_msgs": ("geometry_msgs",),
    "sensor_msgs": ("geometry_msgs",), "nav_msgs": ("geometry_msgs", "actionlib_msgs", "sensor_msgs"),
    "diagnostic_msgs": ("geometry_msgs",), "trajectory_msgs": ("geometry_msgs",), "stereo_msgs": ("sensor_msgs",),
    "visualization_msgs": ("sensor_msgs",), "tf2_msgs": ("geometry_msgs", "action_msgs", "actionlib_msgs"),
    "geographic_msgs": ("geometry_msgs", "unique_identifier_msgs", "uuid_msgs"), "rcl_interfaces": ("service_msgs",),
    "rosgraph_msgs": ("rcl_interfaces", "std_msgs"), "control_msgs": ("trajectory_msgs", "sensor_msgs", "action_msgs"),
    "composition_interfaces": ("rcl_interfaces",), "example_interfaces": ("action_msgs",),
}  # fmt: skip
"""What comes with a package of messages, from its CMakeLists.txt in ROS 1 and 2."""
_FINDS_NONE = frozenset({
    "ament_cmake", "ament_lint_auto", "ament_cmake_ros", "ament_cmake_python", "rosidl_default_generators",
    "rosidl_cmake", "ament_cmake_gtest", "ament_cmake_pytest", "catkin", "message_generation", "message_runtime",
    "genmsg", "roscpp", "rospy",
})  # fmt: skip
"""Packages with which none of messages is found; those of ROS 1 are all found by their own names."""
_OPTIONS = frozenset({
    "DEPENDENCIES", "LIBRARY_NAME", "SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK", "ADD_LINTER_TESTS", "LANGS",
})  # fmt: skip


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each first field of a type that the build does not know, and dependencies that were not found before."""
    if len(view.ros) != 1:
        return
    (generation,) = view.ros
    command = "rosidl_generate_interfaces" if generation == 2 else "generate_messages"
    calls = list(view.cmake.named(command))
    if len(calls) != 1 or calls[0].defined or calls[0].conditions or any("$" in word for word in calls[0].words[1:]):
        return
    given = _given(calls[0])
    if generation == 2:
        yield from _not_found(calls[0], given, view.cmake)
    yield from _unknown_types(calls[0], given, generation, view)


def _given(call: Written) -> tuple[str, ...]:
    """Return the packages behind ``DEPENDENCIES``."""
    found: list[str] = []
    is_behind = False
    for word in call.words:
        is_behind = word == "DEPENDENCIES" if word in _OPTIONS else is_behind
        if is_behind and word not in _OPTIONS:
            found.append(word)
    return tuple(found)


def _not_found(call: Written, given: tuple[str, ...], cmake: CmakeView) -> Iterator[Hit]:
    """Yield what is given to the generator and was not found by ``find_package`` before."""
    packages = {one.words[0] for one in cmake.named("find_package") if one.words}
    if any(one.name.startswith("ament_auto_find") for one in cmake.commands) or any("$" in one for one in packages):
        return
    known = _with_brought(packages)
    if known is None:
        return
    for name in given:
        if name not in known:
            message = f"rosidl_generate_interfaces() is given {name!r}, which no find_package() found before"
            yield call.hit(_ID, f"{message}; expected find_package({name} REQUIRED)", name)


def _with_brought(packages: set[str]) -> set[str] | None:
    """Return packages with all that come with them; None where one of them may bring anything."""
    known: set[str] = set()
    waiting = sorted(packages)
    while waiting:
        name = waiting.pop()
        if name in known or name in _FINDS_NONE:
            continue
        if name not in _BRINGS:
            return None
        known.add(name)
        waiting.extend(_BRINGS[name])
    return known


def _unknown_types(call: Written, given: tuple[str, ...], generation: int, view: PackageView) -> Iterator[Hit]:
    words = {basename(word) for one in view.cmake.commands for word in one.words if word.endswith(_ENDINGS)}
    files = [one for one in view.of_language(*_LANGUAGES, roles=(Role.OWN,)) if basename(one.path) in words]
    known = _with_brought({*given, *(_implied(files) if generation == 2 else ())})
    names = (*words, *(basename(one) for one in view.listing if one.endswith(_ENDINGS)))
    own = {name.rpartition(".")[0] for name in names}
    for file in files:
        for type_, line in _types(file, generation, view):
            if type_.package == view.package.name:
                if generation == 2 and type_.name not in own:
                    yield _unknown_here(file, type_.name, line, view)
            elif known is not None and type_.package not in known:
                yield _not_given(file, type_, line, call)


def _implied(files: Sequence[SourceFile]) -> set[str]:
    """Return what rosidl itself adds; some distributions add less for services."""
    with_action = any(file.language is Language.ACTION for file in files)
    with_service = any(file.language is Language.SRV for file in files)
    return {"action_msgs", "service_msgs"} if with_action or with_service else set()


def _types(file: SourceFile, generation: int, view: PackageView) -> Iterator[tuple[FieldType, int]]:
    """Yield the types of packages in a definition that is understood, each once, with its line."""
    from roslens.source.extract.interfaces.interface_file import read_interface

    interface, failures = read_interface(view.read(file.path), file.path, view.package.name, generation)
    said: set[str] = set()
    for field in (field for part in interface.parts for field in part.fields if not failures):
        if field.type.package and field.type.written not in said:
            said.add(field.type.written)
            yield field.type, field.line


def _unknown_here(file: SourceFile, name: str, line: int, view: PackageView) -> Hit:
    message = f"{name!r} is {view.package.name}/{name} to rosidl, and the package has no such message"
    homes = [package for package in ("std_msgs", "geometry_msgs", "sensor_msgs", "builtin_interfaces")
             if _publishes(package, name)]  # fmt: skip
    advice = f"; expected `{homes[0]}/{name}`" if homes else "; expected the name with its package, or a definition"
    return Hit(_ID, message + advice, line, context=name, path=file.path)


def _publishes(package: str, name: str) -> bool:
    from roslens.source.extract.interfaces.published_interfaces import published_interface

    return published_interface(2, f"{package}/msg/{name}") is not None


def _not_given(file: SourceFile, used: FieldType, line: int, call: Written) -> Hit:
    where = f"{call.name}() ({call.path}:{call.command.line})"
    message = f"{used.written!r} is of {used.package}, which {where} is not given; expected DEPENDENCIES {used.package}"
    return Hit(_ID, message, line, context=used.written, path=file.path)


RULE = PackageRule(
    id=_ID,
    title="Definition with a type that the generator does not know",
    finds="A field of a message, service or action whose type is of a package that is not among the `DEPENDENCIES` of "
    "`rosidl_generate_interfaces` (`generate_messages` in ROS 1), nor comes with one of these; in ROS 2 also a type "
    "without a package that the package itself has not (`Header`), and a dependency that `find_package` did not find "
    "before. Nothing is said where a dependency may bring packages that are not known.",
    why="The interfaces are not generated: the build of the package ends there, and of all that depend on it.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("build", "interface"),
    bad='Header header  # rosidl_generate_interfaces(${PROJECT_NAME} "msg/Load.msg")',
    good='std_msgs/Header header  # rosidl_generate_interfaces(${PROJECT_NAME} "msg/Load.msg" DEPENDENCIES std_msgs)',
    found=found,
)
