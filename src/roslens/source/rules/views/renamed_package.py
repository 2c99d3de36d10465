"""What a package is called now that launch files or a build name, and that the workspace does not have."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

from roslens.source.distributions.read_changes import Effect, Kind, changes_of, effect_of
from roslens.source.rules.system_packages import KEY_OF, is_ros_package

if TYPE_CHECKING:
    from roslens.source.rules.package_view import PackageView

_ALIKE = 0.75
"""Of a name that nothing has and that of a package of the workspace, so that it may be the same package."""


def name_here(name: str, view: PackageView) -> str:
    """Return the package of the workspace that has almost a name and ends alike; empty where the name is there."""
    here = [one for one, _ in view.around.folders]
    if name in here or is_ros_package(name) or name in KEY_OF:
        return ""
    alike = [one for one in here if one.rpartition("_")[2] == name.rpartition("_")[2]]
    return next(iter(get_close_matches(name, alike, 1, _ALIKE)), "")


def name_now(name: str, view: PackageView) -> str:
    """Return a clause on the name that a package has now; empty where nothing says that it has another."""
    for change in changes_of(Kind.PACKAGE).get(name, ()):
        if change.ros in view.ros and effect_of(change, view.around.target) is Effect.REMOVED:
            return f"{name!r} is {change.text()}"
    close = name_here(name, view)
    return f"the workspace has {close!r} and no {name!r}: is that its name now?" if close else ""
