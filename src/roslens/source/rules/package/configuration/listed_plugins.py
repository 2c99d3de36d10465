"""Lists of plug-ins in parameter files of ROS 2, as nav2 reads them: names, and the type of each below its name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec

from roslens.source.extract.facts.launched import Setting
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.views.parameter_files import parameter_files

LISTS = (
    *("plugins", "filters", "controller_plugins", "planner_plugins", "behavior_plugins", "recovery_plugins"),
    *("smoother_plugins", "goal_checker_plugins", "progress_checker_plugins"),
)
"""Parameters of nav2 that list names of plug-ins, each with its type in the parameter ``NAME.plugin``."""


class PluginList(msgspec.Struct, frozen=True):
    """A list of plug-ins and where it stands.

    Attributes:
        path: of the file, below the workspace.
        line: of the list.
        parameter: its name.
        types: by name, in order, the type as written; None where the file has none for it.
        off: names of those that are switched off.
        node: that the list is of, as the file is keyed.
    """

    path: str
    line: int
    parameter: str
    types: Mapping[str, str | None]
    off: frozenset[str] = frozenset()
    node: str = ""


def listed_plugins(view: PackageView) -> Iterator[PluginList]:
    """Yield each list of plug-ins in the parameter files of a package; files that cannot be read have none."""
    for path, settings in parameter_files(view, b"plugin"):
        yield from _lists(settings, path)


def _lists(settings: list[Setting], path: str) -> Iterator[PluginList]:
    values = {(one.node, str(one.name)): str(one.value) for one in settings}
    for one in settings:
        if str(one.name) in LISTS and one.type == "string_array":
            names = [part.strip() for part in str(one.value).strip("[]").split(",") if part.strip()]
            types = {name: values.get((one.node, f"{name}.plugin")) for name in names}
            off = frozenset(name for name in names if values.get((one.node, f"{name}.enabled"), "").lower() == "false")
            yield PluginList(path, one.evidence.line, str(one.name), types, off, one.node)
