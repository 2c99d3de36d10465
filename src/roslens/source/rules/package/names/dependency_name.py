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
_VERSION = re.compile(r"[<>=]=?\s*v?\d")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each dependency whose name nothing can have."""
    for one in view.package.dependencies:
        name = one.name.strip()
        if not name or _NAME.fullmatch(name) or has_placeholder(name) or "$" in name or "@" in name:
            continue
        where = one.location
        message = f"no package and no key of rosdep has the name {shortened(name, 60)!r}"
        message += f"; expected {_expected(name)}"
        yield Hit("package.dependency_name", message, where.line, where.column, context=name, path=where.path)


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
    "nor keys of rosdep have: `rclcpp>`, two names in one tag, a version behind the name.",
    why="Nothing orders the two packages, so that the first build fails or not by chance, and rosdep installs nothing.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad="<depend>std_msgs></depend>",
    good="<depend>std_msgs</depend>",
    found=found,
)
