"""Rule ``package.layer_order``: a cost map that inflates before its obstacles are marked."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package.configuration.listed_plugins import PluginList, listed_plugins
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_INFLATES = "InflationLayer"
_MARKS = frozenset(
    {
        *("StaticLayer", "ObstacleLayer", "VoxelLayer", "NonPersistentVoxelLayer", "RangeSensorLayer"),
        *("SpatioTemporalVoxelLayer", "DenoiseLayer"),
    }
)
"""Classes of layers that mark obstacles, or take them back."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each list in which a layer that marks stands behind the one that inflates."""
    lists = list(listed_plugins(view))
    inflated_again = {
        (one.path, one.node) for one in lists if one.parameter == "filters" and _INFLATES in _classes(one).values()
    }
    for one in lists:
        if (one.path, one.node) in inflated_again:
            # Filters are applied behind all layers.
            continue
        classes = _classes(one)
        names = [name for name in classes if name not in one.off]
        first = next((at for at, name in enumerate(names) if classes[name] == _INFLATES), len(names))
        late = [name for name in names[first + 1 :] if classes[name] in _MARKS]
        if late:
            message = (
                f"{names[first]!r} stands before {', '.join(map(repr, late))} in {one.parameter}: what these mark is "
                "not inflated; expected the inflation layer behind them"
            )
            yield Hit("package.layer_order", message, one.line, context=f"{one.parameter} {names}", path=one.path)


def _classes(one: PluginList) -> dict[str, str]:
    """Return the class of each layer by its name, without the package."""
    return {name: re.split(r"::|/", written or "")[-1] for name, written in one.types.items()}


RULE = PackageRule(
    id="package.layer_order",
    title="Cost map that inflates too early",
    finds="A list `plugins` of a nav2 cost map in which a layer that marks obstacles (`ObstacleLayer`, `VoxelLayer`, "
    "`StaticLayer` …) stands behind `nav2_costmap_2d::InflationLayer`, neither switched off nor inflated again by "
    "`filters`. Put the inflation layer behind them.",
    why="Layers are applied in the order of the list, and inflation only sees what was marked before it: the robot "
    "plans as close to these obstacles as its cells allow.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("configuration", "plugin"),
    bad='plugins: ["inflation_layer", "obstacle_layer"]',
    good='plugins: ["obstacle_layer", "inflation_layer"]',
    found=found,
)
