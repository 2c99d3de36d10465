"""Rule ``launch.list_as_text``: a list that ``<param>`` of ROS 1 makes a text of."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_LIST = re.compile(r"\[\s*[-+\d.eE]+(?:\s*,\s*[-+\d.eE]+)*\s*,?\s*\]")
_LISTS = re.compile(r"(?:^|/)(?:\w+_covariance(?:_diagonal)?|(?:odom|imu|pose|twist)\d+_config|initial_state|datum)$")
"""Parameters of programs of ROS that are lists: odometry of ros_controllers, robot_localization."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each parameter of ROS 1 whose value is a list of numbers, and that becomes a text."""
    if view.ros != frozenset({1}):
        return
    for file in view.launch:
        for element, _ in () if file.is_test or "[" not in file.text else file.elements:
            value = element.attributes.get("value", "").strip()
            if element.tag != "param" or not _LIST.fullmatch(value) or element.attributes.get("type", "auto") != "auto":
                continue
            name = element.attributes.get("name", "")
            message = (
                f"parameter {name!r} becomes the text {value!r}: param knows no lists; expected "
                f'`<rosparam param="{name}">{value}</rosparam>`, or type="yaml"'
            )
            hit = file.hit("launch.list_as_text", element, message, name)
            yield hit if _LISTS.search(name) else _doubtful(hit)


def _doubtful(hit: Hit) -> Hit:
    """Return a hit on a parameter that its program may take apart itself."""
    import msgspec

    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)


RULE = PackageRule(
    id="launch.list_as_text",
    title="List of numbers that becomes a text",
    finds='`<param value="[1, 2, 3]">` in a launch file of ROS 1: `param` sets texts, numbers and bools, so that the '
    "value is a text. Set lists by `rosparam`. Where the parameter is not known to be a list it is a note: some "
    "programs take the text apart.",
    why="The program asks for a list, finds a text, and ends or takes its default.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("launch", "parameters"),
    bad='<param name="pose_covariance_diagonal" value="[0.2, 0.2, 0.2, 0.2, 0.2, 0.2]"/>',
    good='<rosparam param="pose_covariance_diagonal">[0.2, 0.2, 0.2, 0.2, 0.2, 0.2]</rosparam>',
    found=found,
)
