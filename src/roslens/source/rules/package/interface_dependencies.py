"""Rule ``package.interface_dependencies``: a package of messages whose manifest does not say so."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_LISTING = ("add_message_files", "add_service_files", "add_action_files")
_FOLDERS = ("msg/", "srv/", "action/")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield what the manifest of a package that generates interfaces lacks."""
    manifest = view.manifest_edits
    kinds: dict[str, set[str]] = {}
    for one in view.package.dependencies:
        kinds.setdefault(one.name, set()).add(one.kind)
    groups = {one.name for one in view.package.member_of_groups}
    made = view.cmake.first("rosidl_generate_interfaces")
    if made is not None and not _is_aside(made) and "rosidl_interface_packages" not in groups:
        message = "the package generates interfaces; expected <member_of_group>rosidl_interface_packages"
        edits = manifest.added("member_of_group", "rosidl_interface_packages") if manifest.format == 3 else ()
        yield _hit(view, message, "rosidl_interface_packages", Certainty.PROVEN, edits)
    made = view.cmake.first("generate_messages")
    if made is not None and not made.defined and 1 in view.ros and _has_messages(view):
        yield from _of_ros1(view, kinds)


def _of_ros1(view: PackageView, kinds: Mapping[str, Set[str]]) -> Iterator[Hit]:
    """Yield what the manifest of a package of messages for ROS 1 lacks.

    A generator that CMake finds is there today, and what lacks at run time builds: the next machine is without them.
    """
    manifest = view.manifest_edits
    if "message_generation" not in kinds:
        message = "the package generates messages; expected <build_depend>message_generation"
        edits = manifest.added("build_depend", "message_generation")
        if any(use.name == "message_generation" for use in view.uses):
            yield _hit(view, message, "message_generation", Certainty.PROVEN, edits, Consequence.HARD_TO_MAINTAIN)
        else:
            yield _hit(view, message, "message_generation", Certainty.LIKELY, edits)
    if not kinds.get("message_runtime", set()) & {"exec", "run", "depend", "build_export"}:
        message = "the package generates messages; expected <exec_depend>message_runtime"
        edits = manifest.added("run_depend" if manifest.format == 1 else "exec_depend", "message_runtime")
        yield _hit(view, message, "message_runtime", Certainty.PROVEN, edits, Consequence.HARD_TO_MAINTAIN)


def _has_messages(view: PackageView) -> bool:
    """Return whether there is something to generate: the call alone is left over from a template."""
    if "genmsg" in view.cmake.text:
        return False
    return view.cmake.first(*_LISTING) is not None or any(path.startswith(_FOLDERS) for path in view.listing)


def _is_aside(command: Written) -> bool:
    return command.for_tests or command.defined or "SKIP_INSTALL" in command.words


def _hit(
    view: PackageView,
    message: str,
    context: str,
    certainty: Certainty,
    edits: tuple[Edit, ...],
    milder: Consequence | None = None,
) -> Hit:
    where = view.package.manifest
    rule = "package.interface_dependencies"
    if len(view.ros) > 1:
        edits = ()
    return Hit(
        rule,
        message,
        where.line,
        where.column,
        context=context,
        path=where.path,
        certainty=certainty,
        edits=edits,
        consequence=milder,
    )


RULE = PackageRule(
    id="package.interface_dependencies",
    title="Package of messages whose manifest does not say so",
    finds="A package that calls `rosidl_generate_interfaces` without "
    "`<member_of_group>rosidl_interface_packages</member_of_group>`, or, in ROS 1, `generate_messages` without "
    "`message_generation` to build and `message_runtime` to run. A `generate_messages` that a template left in a "
    "package without messages is none.",
    why="rosidl ends the build with an error. In ROS 1 the build depends on what else is installed, and programs "
    "that use the messages lack their serialisation on a robot.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest", "interface"),
    fix="Adds the element. A manifest of an older format has no groups: it is left, and so is one for both "
    "versions of ROS.",
    bad='<package format="3">  <!-- CMakeLists.txt: rosidl_generate_interfaces(…) -->',
    good="<member_of_group>rosidl_interface_packages</member_of_group>",
    found=found,
)
