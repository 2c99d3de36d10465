"""Rule ``distribution.parameter_gone``: a parameter of a controller that a distribution does not read any more."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.read_changes import Kind, changes_of
from roslens.source.extract.facts.launched import Setting
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.parameter_files import parameter_files

_MANAGER = "controller_manager"


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each parameter of the tables that is set for a controller of that type."""
    for path, settings in parameter_files(view, b"type"):
        yield from _gone(settings, path)


def _gone(settings: list[Setting], path: str) -> Iterator[Hit]:
    types = {
        str(one.name).removesuffix(".type"): str(one.value)
        for one in settings
        if str(one.name).endswith(".type") and one.node.rpartition("/")[2] in (_MANAGER, "**")
    }
    for one in settings:
        owner = types.get(one.node.rpartition("/")[2], "")
        for change in changes_of(Kind.PARAMETER).get(f"{owner}:{one.name}", ()) if owner else ():
            message = f"parameter `{one.name}` of `{owner}` is {change.text()}"
            line = one.evidence.line
            yield Hit("distribution.parameter_gone", message, line, context=change.name, path=path, change=change.key)


RULE = PackageRule(
    id="distribution.parameter_gone",
    title="Parameter that the distribution does not read",
    finds="A parameter that a file sets for a controller, and that the type of the controller does not read any more "
    "in a distribution of ROS, by a dated table: `use_stamped_vel` of diff_drive_controller from Jazzy on. For which "
    "distributions a package is built, `distro` in roslens.toml or `--distro` says; otherwise files of continuous "
    "integration and containers do. What is gone in a later distribution where none is known is a note.",
    why="The value has no effect, and nothing says so: the robot runs with another one.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("distribution", "parameters"),
    bad="controller_manager:\n  ros__parameters:\n    drive:\n      type: diff_drive_controller/DiffDriveController\n"
    "drive:\n  ros__parameters:\n    use_stamped_vel: false",
    good="controller_manager:\n  ros__parameters:\n    drive:\n      type: diff_drive_controller/DiffDriveController\n"
    "drive:\n  ros__parameters:\n    wheel_radius: 0.05",
    found=found,
)
