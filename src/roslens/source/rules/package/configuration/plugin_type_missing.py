"""Rule ``package.plugin_type_missing``: a plug-in that a parameter file lists and gives no type."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package.configuration.listed_plugins import listed_plugins
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_DEFAULTS: Mapping[str, tuple[frozenset[str], ...]] = {
    "plugins": (frozenset({"static_layer", "obstacle_layer", "inflation_layer"}),),
    "controller_plugins": (frozenset({"FollowPath"}),),
    "planner_plugins": (frozenset({"GridBased"}),),
    "goal_checker_plugins": (frozenset({"goal_checker"}),),
    "progress_checker_plugins": (frozenset({"progress_checker"}),),
    "smoother_plugins": (frozenset({"simple_smoother"}),),
    "behavior_plugins": (
        frozenset({"spin", "backup", "drive_on_heading", "wait"}),
        frozenset({"spin", "backup", "drive_on_heading", "assisted_teleop", "wait"}),
    ),
    "recovery_plugins": (frozenset({"spin", "backup", "wait"}),),
}
"""The lists for which a server of nav2 knows the types itself: it declares them where its list is the default one, and
none where a name is missing or added (``Costmap2DROS``, ``ControllerServer``, ``BehaviorServer`` … of navigation2)."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each name without a type in a list of which the file gives types for others."""
    for one in listed_plugins(view):
        missing = [name for name, written in one.types.items() if written is None]
        if len(missing) == len(one.types) or frozenset(one.types) in _DEFAULTS.get(one.parameter, ()):
            # Another file may have the types of all of them.
            continue
        for name in missing:
            if _is_elsewhere(name, one.path, view):
                continue
            message = f"{one.parameter} lists {name!r}, and nothing gives its type; expected a parameter {name}.plugin"
            yield Hit("package.plugin_type_missing", message, one.line, context=name, path=one.path)


def _is_elsewhere(name: str, path: str, view: PackageView) -> bool:
    """Return whether another file of the package names a plug-in: it may give the type, or write a file that does."""
    word = re.compile(rb"\b" + re.escape(name.encode()) + rb"\b")
    files = view.of_language(Language.YAML, Language.LAUNCH_PYTHON, Language.LAUNCH_XML, Language.PYTHON, Language.CPP)
    return any(word.search(view.read(file.path)) for file in files if file.path != path)


RULE = PackageRule(
    id="package.plugin_type_missing",
    title="Listed plug-in without a type",
    finds="A name in `plugins`, `controller_plugins`, `planner_plugins` and the like of a nav2 server, for which the "
    "parameter file has no `NAME.plugin`, although it has one for another name of the list, and which no other "
    "file of the package names. A list that is the default one of the server needs no types.",
    why="The server ends with «Can not get 'plugin' param value» when it is configured, and navigation does not start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("configuration", "plugin"),
    bad='plugins: ["voxel_layer", "inflation_layer"]\ninflation_layer:\n  plugin: "nav2_costmap_2d::InflationLayer"',
    good='plugins: ["inflation_layer"]\ninflation_layer:\n  plugin: "nav2_costmap_2d::InflationLayer"',
    found=found,
)
