"""Rule ``launch.missing_include``: a launch file includes a file, or gives one of parameters, that is not there."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.facts.launched import Fault
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_outcome import Outcome
from roslens.source.rules.views.package_beside import PackageBeside

_WITHOUT = re.compile(r"(?:^|/)[_.-]|[_-][./]|//")
"""In a path: the default of an argument is empty, which is meant to be given."""
_RULE = "launch.missing_include"


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each place at which a file is included, or given as one of parameters, that its package does not have."""
    beside: dict[str, PackageBeside] = {}
    for one in view.outcome.failures:
        failed = one.failed
        if failed.fault is not Fault.MISSING_FILE or failed.evidence.path not in view.by_path:
            continue
        owner = _owner(failed.text, view)
        if owner is None:
            continue
        name, folder = owner
        package = beside.setdefault(folder, PackageBeside(view.root, folder))
        inside = failed.text[len(folder) + 1 :] if folder else failed.text
        if inside.startswith("~") or package.may_have(inside) or package.installs_what_it_makes(inside):
            continue
        if not is_written(view.read(failed.evidence.path).decode("utf-8", "replace"), inside):
            yield _hit(one, name, inside, package)


def _owner(path: str, view: PackageView) -> tuple[str, str] | None:
    """Return the name and folder of the package whose file a path is; None where it is of none in the workspace."""
    folders = [(name, "" if folder == "." else folder) for name, folder in view.around.folders]
    around = [one for one in folders if path.startswith(f"{one[1]}/" if one[1] else "")]
    return max(around, key=lambda one: len(one[1]), default=None)


def is_written(text: str, path: str) -> bool:
    """Return whether a launch file has a program write the file of a path: it is named behind ``-o`` or ``>``."""
    name = re.escape(path.rpartition("/")[2])
    return re.search(rf"(?:-o|--out\w*|>|&gt;|outfile:?=)[\s'\",=]*[^\s'\",]*{name}", text) is not None


def _hit(one: Outcome, name: str, inside: str, package: PackageBeside) -> Hit:
    failed = one.failed
    near = package.like(inside)
    advice = f"; did you mean {near!r}?" if near else ""
    started = "" if failed.evidence.path == one.source.path else f", when {one.source.path} is started"
    by = " by the default of an argument" if one.by_default else ""
    message = f"{inside!r} is no file of package {name}, and is named here{by}{started}; expected a file of it{advice}"
    line, column = failed.evidence.line, failed.evidence.column
    return Hit(
        _RULE, message, line, column, context=inside, path=failed.evidence.path, certainty=_certainty(one, package)
    )


def _certainty(one: Outcome, package: PackageBeside) -> Certainty | None:
    # What is left over from ROS 1 beside packages for ROS 2 nobody starts.
    if not one.source.is_ros2 and package.is_for_ros2:
        return Certainty.HEURISTIC
    if one.by_default and (one.is_included or _WITHOUT.search(one.failed.text)):
        return Certainty.HEURISTIC
    return Certainty.LIKELY if one.failed.open or one.by_default else None


RULE = PackageRule(
    id=_RULE,
    title="Include or file of parameters that is not there",
    finds="An included launch file, or a file of parameters that a node is given, below a package of the workspace "
    "that does not have it, whatever its build makes and installs, in XML, YAML and Python. It is a warning "
    "where a default of an argument names it, or a condition decides whether it is reached, and a note where other "
    "launch files include the one that does, or the default is empty. Files of packages that are not in the "
    "workspace, that the launch file has a program write, and that lie in submodules that were not fetched are left "
    "out.",
    why="launch and roslaunch end with that file: nothing starts, or not on the day that the branch is taken.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("launch",),
    bad="IncludeLaunchDescription(\n    os.path.join(get_package_share_directory('base_bringup'), 'launch', "
    "'lidr.launch.py')\n)",
    good="IncludeLaunchDescription(\n    os.path.join(get_package_share_directory('base_bringup'), 'launch', "
    "'lidar.launch.py')\n)",
    found=found,
)
