"""Rule ``package.dependency_kind``: a dependency is declared for another time than that of its use."""

from __future__ import annotations

import re
from collections.abc import Iterator, Set

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.dependency_uses import BUILD, RUN, TEST, Use

_FOR_BUILD = frozenset({"build", "depend", "buildtool", "build_export", "buildtool_export"})
_FOR_RUN = frozenset({"exec", "run", "depend"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each dependency that the build, or a program, needs and that is declared for something else only."""
    kinds: dict[str, set[str]] = {}
    for one in view.package.dependencies:
        kinds.setdefault(one.name, set()).add(one.kind)
    reported: set[str] = set()
    for use in view.uses:
        declared = kinds.get(use.name)
        if declared is None or use.name in reported or not _is_for_something_else(use, declared, view):
            continue
        if use.when == BUILD and _is_brought(use.name, kinds):
            continue
        reported.add(use.name)
        yield _hit(use, declared, view)


def _is_for_something_else(use: Use, declared: Set[str], view: PackageView) -> bool:
    """Whether what is used is declared, and not for what it is used for."""
    if use.when == TEST or not use.required or use.name == "catkin":
        return False
    wanted = _FOR_BUILD if use.when == BUILD else _FOR_RUN
    if declared & wanted or (use.when == RUN and not _runs(use, view)):
        return False
    return bool(declared & {"build", "exec", "run", "test", "doc", "buildtool"})


def _hit(use: Use, declared: Set[str], view: PackageView) -> Hit:
    has = ", ".join(f"<{kind if kind == 'depend' else f'{kind}_depend'}>" for kind in sorted(declared))
    expected = "<build_depend> or <depend>" if use.when == BUILD else "<exec_depend> or <depend>"
    place = next(one for one in view.package.dependencies if one.name == use.name).location
    at = f"{use.path}:{use.line}"
    return Hit(
        "package.dependency_kind",
        f"{use.name!r} is declared by {has}, and {at} uses it: {use.how}; expected {expected}",
        place.line,
        place.column,
        context=use.name,
        path=place.path,
        edits=_widened(use.name, declared, view),
    )


def _widened(name: str, declared: Set[str], view: PackageView) -> tuple[Edit, ...]:
    """Return what makes the only declaration of a package one for the build and for running."""
    manifest = view.manifest_edits
    elements = list(manifest.elements(text=name))
    if manifest.format < 2 or len(declared) != 1 or declared & {"doc", "buildtool"} or len(elements) != 1:
        return ()
    return manifest.renamed(elements[0], "depend") if elements[0].tag.endswith("_depend") else ()


def _is_brought(name: str, kinds: dict[str, set[str]]) -> bool:
    """Return whether a system package that the build needs is that of the name: ``libgazebo11-dev`` of ``gazebo``."""
    own = re.compile(
        rf"(?:lib)?{re.escape(name.replace('_', '-').removesuffix('-ros'))}[\d.]*(?:[-_]dev)?", re.IGNORECASE
    )
    return any(own.fullmatch(one) and one != name and kind & _FOR_BUILD for one, kind in kinds.items())


def _runs(use: Use, view: PackageView) -> bool:
    """Return whether a module is one that runs, and no setup.py or generator."""
    inside = view.inside(use.path)
    return not inside.startswith(("setup.py", "cmake/", "doc/", "docs/", "test/", "tests/", "test_"))


RULE = PackageRule(
    id="package.dependency_kind",
    title="Dependency declared for another time than that of its use",
    finds="What CMakeLists.txt finds outside of tests, or C++ includes, and package.xml declares for tests or for "
    "running only; and what Python imports and package.xml declares for the build or for tests only.",
    why="Where packages are installed for their purpose (robots get no test dependencies, build machines no "
    "others), the build fails, or the node ends with an ImportError.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest", "dependency"),
    clauses=("catkin_lint missing_build_depend",),
    fix="Makes `<depend>` of the only declaration, which is for the build and for running.",
    bad="<test_depend>sensor_msgs</test_depend>  <!-- #include <sensor_msgs/msg/imu.hpp> in src/driver.cpp -->",
    good="<depend>sensor_msgs</depend>",
    found=found,
)
