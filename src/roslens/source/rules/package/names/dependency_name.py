"""Rule ``package.dependency_name``: a dependency with characters that no name of a package has."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.placeholder import has_placeholder

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.+-]*")
"""Names of packages, and keys of rosdep (``libstdc++5``, ``qtbase5-dev``, ``python3.8``)."""
_PARTS = re.compile(r"[A-Za-z0-9_.+-]*[A-Za-z0-9_+]")
_OF_PYTHON = re.compile(
    r"python3?-(?:abc|ast|base64|bisect|cmath|collections|copy|csv|ctypes|datetime|functools|glob|io|itertools|json|math"
    r"|os|pathlib|pickle|queue|random|re|select|shutil|signal|socket|statistics|string|struct|subprocess|sys|tempfile"
    r"|threading|time|traceback|types|uuid)"
)
"""A module that comes with Python, as if it were a package of its own."""
_BUILD_TYPE = "ament_python"
_VERSION = re.compile(r"[<>=]=?\s*v?\d")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each dependency whose name nothing can have."""
    for one in view.package.dependencies:
        name = one.name.strip()
        if (expected := _instead(name)) and name not in view.around.own:
            where = one.location
            message = f"rosdep has no key {name!r}, and stops there; expected {expected}"
            yield Hit("package.dependency_name", message, where.line, where.column, context=name, path=where.path)
            continue
        if not name or _NAME.fullmatch(name) or has_placeholder(name) or "$" in name or "@" in name:
            continue
        where = one.location
        message = f"no package and no key of rosdep has the name {shortened(name, 60)!r}"
        message += f"; expected {_expected(name)}"
        yield Hit("package.dependency_name", message, where.line, where.column, context=name, path=where.path)


def _instead(name: str) -> str:
    """Return what is expected in the place of a name that looks like one of a package, and that nothing has."""
    if name == _BUILD_TYPE:
        return "no dependency: <build_type> in <export> says how it is built"
    return "no dependency: Python brings the module" if _OF_PYTHON.fullmatch(name) else ""


def _expected(name: str) -> str:
    parts = _PARTS.findall(name)
    if _VERSION.search(name) and parts:
        return f"{parts[0]!r}, and a version in an attribute (version_gte and the like)"
    if len(parts) == 1:
        return repr(parts[0])
    return "letters, digits, '_', '-', '.' and '+', and a tag for each dependency"


RULE = PackageRule(
    id="package.dependency_name",
    title="Dependency with a name that nothing can have",
    finds="A dependency tag whose text has blanks, brackets, commas or other characters that neither names of packages "
    "nor keys of rosdep have: `rclcpp>`, two names in one tag, a version behind the name. Also `ament_python`, "
    "which is a build type and no package, and modules that come with Python (`python-os`).",
    why="Nothing orders the two packages, so that the first build fails or not by chance, and rosdep installs nothing.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad="<depend>std_msgs></depend>",
    good="<depend>std_msgs</depend>",
    found=found,
)
