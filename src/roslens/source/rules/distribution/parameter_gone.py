"""Rule ``distribution.parameter_gone``: a parameter that a distribution does not read any more."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

import msgspec

from roslens.model.edit import Edit, edit_at
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.read_changes import Change, Kind, changes_of
from roslens.source.extract.facts.launched import Setting
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.parameter_files import parameter_files

_MANAGER = "controller_manager"
_NODES = {
    "bt_navigator": "nav2_bt_navigator/bt_navigator",
    "global_costmap": "nav2_costmap_2d/nav2_costmap_2d",
    "local_costmap": "nav2_costmap_2d/nav2_costmap_2d",
}
"""By the name that nodes have everywhere, what owns their parameters in the tables."""


class _Owners(msgspec.Struct, frozen=True):
    """What the parameters of a file belong to.

    Attributes:
        controllers: types by the names of nodes.
        plugins: types by the names of a node and of the namespace in it.
    """

    controllers: dict[str, str]
    plugins: dict[tuple[str, str], str]

    def of(self, one: Setting) -> Iterator[tuple[str, str]]:
        """Yield each owner that a parameter may have, with the name of the parameter there."""
        node, name = one.node.rpartition("/")[2], str(one.name)
        for owner in (self.controllers.get(node, ""), _NODES.get(node, "")):
            if owner:
                yield owner, name
        space, _, last = name.rpartition(".")
        if (plugin := self.plugins.get((one.node, space), "")) and space:
            yield plugin, last


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each parameter of the tables that is set for a controller, plug-in or node of which it was one."""
    for path, settings in parameter_files(view, _words()):
        yield from _gone(settings, path, view)


@cache
def _words() -> re.Pattern[bytes]:
    """Return a pattern of the last parts of all names of the table, as keys of a file."""
    names = {re.split(r"[:.]", name)[-1] for name in changes_of(Kind.PARAMETER)}
    return re.compile(rb"\b(?:" + "|".join(sorted(map(re.escape, names))).encode() + rb")[ \t]*:")


def _gone(settings: list[Setting], path: str, view: PackageView) -> Iterator[Hit]:
    owners = _owners(settings)
    for one in settings:
        for owner, name in owners.of(one):
            for change in changes_of(Kind.PARAMETER).get(f"{owner}:{name}", ()):
                message = f"parameter `{one.name}` of `{owner}` is {change.text()}"
                yield Hit(
                    "distribution.parameter_gone",
                    message,
                    one.evidence.line,
                    context=change.name,
                    path=path,
                    change=change.key,
                    edits=_renamed(name, change, one.evidence.line, path, view),
                )


def _owners(settings: list[Setting]) -> _Owners:
    controllers: dict[str, str] = {}
    plugins: dict[tuple[str, str], str] = {}
    for one in settings:
        space, _, last = str(one.name).rpartition(".")
        if last == "type" and one.node.rpartition("/")[2] in (_MANAGER, "**"):
            controllers[space] = str(one.value)
        if last == "plugin" and space:
            plugins[one.node, space] = str(one.value)
    return _Owners(controllers, plugins)


def _renamed(name: str, change: Change, line: int, path: str, view: PackageView) -> tuple[Edit, ...]:
    """Return what writes the new name in the place of the old one; nothing where the line has no such key."""
    if not change.alike:
        return ()
    content = view.read(path)
    start = 0
    for _ in range(line - 1):
        start = content.find(b"\n", start) + 1
    key = re.compile(rb"[ \t]*(" + re.escape(name.encode()) + rb")[ \t]*:").match(content, start)
    return () if key is None else (edit_at(content, *key.span(1), change.instead, path),)


RULE = PackageRule(
    id="distribution.parameter_gone",
    title="Parameter that the distribution does not read",
    finds="A parameter that a file sets for a controller of ros2_control, a plug-in or node of Nav2, and that it does "
    "not read any more in a distribution of ROS, by a dated table: `use_stamped_vel` of diff_drive_controller from "
    "Jazzy on, `desired_linear_vel` of the regulated pure pursuit controller from Lyrical on. For which "
    "distributions a package is built, `distro` in roslens.toml or `--distro` says; otherwise files of continuous "
    "integration and containers do. What is gone in a later distribution where none is known is a note.",
    why="The value has no effect, and nothing says so: the robot runs with another one.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("distribution", "parameters"),
    fix="Writes the new name where it takes the old one's place as it is, and every distribution that is built for "
    "has it.",
    bad="controller_manager:\n  ros__parameters:\n    drive:\n      type: diff_drive_controller/DiffDriveController\n"
    "drive:\n  ros__parameters:\n    use_stamped_vel: false",
    good="controller_manager:\n  ros__parameters:\n    drive:\n      type: diff_drive_controller/DiffDriveController\n"
    "drive:\n  ros__parameters:\n    wheel_radius: 0.05",
    found=found,
)
