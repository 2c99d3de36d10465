"""Rule ``cmake.catkin_depends``: what a package says that others need with it, and does not have itself."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_AFTER = frozenset(
    {"INCLUDE_DIRS", "LIBRARIES", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS", "SKIP_CMAKE_CONFIG_GENERATION"}
)
_FOR_OTHERS = frozenset({"run", "exec", "depend", "build_export", "buildtool_export"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each package below ``CATKIN_DEPENDS`` that the manifest does not declare for those who use the package."""
    command = view.cmake.first("catkin_package")
    if command is None or command.defined or "CATKIN_DEPENDS" not in command.words:
        return
    words = command.words[command.words.index("CATKIN_DEPENDS") + 1 :]
    kinds: dict[str, set[str]] = {}
    for one in view.package.dependencies:
        kinds.setdefault(one.name, set()).add(one.kind)
    for word in words:
        if word in _AFTER:
            return
        if word == "CATKIN_DEPENDS":
            continue
        declared = kinds.get(word, set())
        if "$" not in word and not declared & _FOR_OTHERS:
            has = f"by <{min(declared)}_depend> only" if declared else "not at all"
            message = f"CATKIN_DEPENDS names {word!r}, which package.xml declares {has}; expected <depend>"
            yield command.hit("cmake.catkin_depends", message, word)


RULE = PackageRule(
    id="cmake.catkin_depends",
    title="Exported dependency that the manifest does not declare",
    finds="A package below `CATKIN_DEPENDS` in `catkin_package()` that package.xml declares neither by `<depend>`, "
    "`<build_export_depend>`, `<exec_depend>` nor `<run_depend>`.",
    why="Whoever depends on this package gets its name from CMake and not from rosdep: their build fails on a "
    "machine that does not happen to have it.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.HEURISTIC,
    profiles=("ros1",),
    tags=("build", "dependency"),
    clauses=("catkin_lint missing_catkin_depend",),
    bad="catkin_package(CATKIN_DEPENDS tf)  # package.xml: <build_depend>tf</build_depend>",
    good="catkin_package(CATKIN_DEPENDS tf)  # package.xml: <depend>tf</depend>",
    found=found,
)
