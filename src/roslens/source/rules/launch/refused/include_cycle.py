"""Rule ``launch.include_cycle``: a launch file includes itself."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.facts.launched import Fault
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each include that leads back to a file in which it stands, under no condition."""
    for one in view.outcome.failures:
        failed = one.failed
        if failed.fault is Fault.CYCLE and not failed.open and failed.evidence.path in view.by_path:
            message = f"{failed.reason}; expected an include that ends, or a condition that ends it"
            line, column = failed.evidence.line, failed.evidence.column
            yield Hit("launch.include_cycle", message, line, column, context=failed.text, path=failed.evidence.path)


RULE = PackageRule(
    id="launch.include_cycle",
    title="Launch file that includes itself",
    finds="An include that leads back to the file in which it stands, directly or through others, without a condition "
    "that could end it.",
    why="launch and roslaunch go round until Python ends them: nothing starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("launch",),
    bad='<!-- in base.launch.xml --><launch>\n  <include file="$(find-pkg-share bringup)/launch/base.launch.xml"/>\n'
    "</launch>",
    good='<!-- in base.launch.xml --><launch>\n  <include file="$(find-pkg-share bringup)/launch/lidar.launch.xml"/>\n'
    "</launch>",
    found=found,
)
