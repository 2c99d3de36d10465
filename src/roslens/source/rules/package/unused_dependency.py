"""Rule ``package.unused_dependency``: a dependency that nothing in the package names."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from roslens.model.source import Dependency, Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.system_packages import HEADERS, looks_like_ros_package

_KINDS = frozenset({"build", "depend", "build_export"})
_BY_SUFFIX = {"xacro": ".xacro", "dynamic_reconfigure": ".cfg", "urdf": ".urdf"}
_OF_INTERFACES = frozenset({"std_msgs", "builtin_interfaces", "actionlib_msgs", "action_msgs", "service_msgs"})
_INTERFACES = (Language.MSG, Language.SRV, Language.ACTION)
_BINARY = (".dae", ".stl", ".png", ".bag")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each dependency of the build whose name stands nowhere but in package.xml."""
    if view.package.metapackage or not view.cmake.exists or len(view.files) <= 2:
        return
    if any(file.role is Role.VENDORED for file in view.files):
        return
    for name, one in _unnamed(_asked(view), view).items():
        where = one.location
        tag = one.kind if one.kind == "depend" else f"{one.kind}_depend"
        message = f"nothing in the package names {name!r}; expected its use, or no <{tag}>"
        yield Hit("package.unused_dependency", message, where.line, where.column, context=name, path=where.path)


def _asked(view: PackageView) -> dict[str, Dependency]:
    """Return the dependencies of which the rule asks, the first of each name."""
    asked: dict[str, Dependency] = {}
    for one in view.package.dependencies:
        if one.kind in _KINDS and one.active and _is_asked(one.name) and one.name not in asked:
            asked[one.name] = one
    return asked


def _unnamed(asked: Mapping[str, Dependency], view: PackageView) -> dict[str, Dependency]:
    """Return the dependencies that no file names, manifests and CMake files aside."""
    words = _words(view)
    left = {name: one for name, one in asked.items() if not _is_used(name, words, view)}
    for file in view.files if left else ():
        if file.language in (Language.MANIFEST, Language.CMAKE):
            continue
        text = view.read(file.path)
        left = {name: one for name, one in left.items() if name.encode() not in text}
        if not left:
            break
    return left


def _is_asked(name: str) -> bool:
    # What only brings others is named nowhere.
    return looks_like_ros_package(name) and not name.endswith(("_meta", "_dependencies", "_vendor", "_cmake"))


def _words(view: PackageView) -> frozenset[str]:
    found = set(re.findall(r"[A-Za-z_][\w-]*", view.cmake.text))
    for facts in view.facts.values():
        for written, _ in facts.includes:
            path = written.strip('<>"')
            parts = re.split(r"[/.]", path)
            # Headers of autoware_motion_utils are in autoware/motion_utils.
            found.update((path, parts[0], "_".join(parts[:2]), "_".join(parts[:3])))
    return frozenset(found)


def _is_used(name: str, words: frozenset[str], view: PackageView) -> bool:
    if name in words:
        return True
    begins = HEADERS.get(name, ())
    if begins and any(word.startswith(begins) for word in words):
        return True
    if name in _OF_INTERFACES and any(file.language in _INTERFACES for file in view.files):
        return True
    ending = _BY_SUFFIX.get(name)
    return ending is not None and any(path.endswith(ending) for path in view.listing)


RULE = PackageRule(
    id="package.unused_dependency",
    title="Dependency that nothing uses",
    finds="A `<depend>`, `<build_depend>` or `<build_export_depend>` on a package of ROS whose name stands nowhere "
    "else in the package: in no CMake file, include, import, launch file or configuration. Remove it, or declare "
    "what it is really for.",
    why="It is installed and built on every machine, makes the workspace rebuild when it changes, and forbids to "
    "use the package where it is not available.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("manifest", "dependency"),
    bad="<depend>nav_msgs</depend>  <!-- no source uses it -->",
    good="<exec_depend>nav_msgs</exec_depend>  <!-- for a launch file that names it -->",
    found=found,
)
