"""Rule ``launch.shared_default``: an included file gets the argument of the file that is included before it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Shared


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each include whose file declares a default that another included file made void."""
    said: set[tuple[str, int, str]] = set()
    for run in view.launch_runs:
        for one in run.launch.shared:
            at = one.include
            if at.path in view.by_path and (at.path, at.line, one.name) not in said:
                said.add((at.path, at.line, one.name))
                yield Hit("launch.shared_default", _message(one), at.line, at.column, context=one.name, path=at.path)


def _message(one: Shared) -> str:
    declared, left = (f"{place.path}:{place.line}" for place in (one.evidence, one.left_by))
    return (
        f"argument {one.name!r} of {declared} is {one.value!r} here, not its default {one.default!r}: an include opens "
        f"no scope, and {left} sets it before; expected GroupAction (<group>) around each include, or a value for it"
    )


RULE = PackageRule(
    id="launch.shared_default",
    title="Included file with the argument of another one",
    finds="A launch file of ROS 2 that includes two files which declare an argument of one name with different "
    "defaults, or gives the first of them a value and the second none: the second gets what the first has. Launch "
    "files are evaluated with the defaults of their arguments.",
    why="An include opens no scope for launch configurations. The second file starts with a value that nobody chose "
    "for it: the rate, the file of parameters or the name of another device.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch",),
    bad='<include file="front.launch.xml"/>  <!-- <arg name="rate" default="30"/> -->\n'
    '<include file="rear.launch.xml"/>   <!-- <arg name="rate" default="5"/> -->',
    good='<group><include file="front.launch.xml"/></group>\n<group><include file="rear.launch.xml"/></group>',
    found=found,
)
