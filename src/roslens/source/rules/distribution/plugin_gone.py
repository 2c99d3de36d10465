"""Rule ``distribution.plugin_gone``: a name by which a distribution of ROS loads no plug-in any more."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

from roslens.model.edit import edit_at
from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.read_changes import Change, Kind, changes_of
from roslens.source.rules.distribution.row_hit import row_message
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_TOP_KEY = re.compile(rb"^[\"']?([\w/*]+)[\"']?:", re.MULTILINE)
_FORMER_NODES = frozenset({b"recoveries_server"})
"""Nodes that are called otherwise since before any of the tables: nothing reads what is left under their names."""
_LANGUAGES = (Language.YAML, Language.XACRO, Language.URDF, Language.XML)


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each value of a parameter file, and each text in a robot description, that is a name of the tables."""
    for file in view.of_language(*_LANGUAGES, roles=(Role.OWN,)):
        content = view.read(file.path)
        for match in _names().finditer(content):
            name = match[1].decode()
            line_start = content.rfind(b"\n", 0, match.start(1)) + 1
            if b"#" in content[line_start : match.start(1)] and file.language is Language.YAML:
                continue
            for change in changes_of(Kind.PLUGIN)[name]:
                yield _hit(change, match, content, file.path, is_yaml=file.language is Language.YAML)


def _hit(change: Change, match: re.Match[bytes], content: bytes, path: str, *, is_yaml: bool) -> Hit:
    start, end = match.span(1)
    edits = (edit_at(content, start, end, change.instead, path),) if change.alike and is_yaml else ()
    line = content.count(b"\n", 0, start) + 1
    message = f"plug-in {row_message(change, change.name)}"
    node = _node_above(content, start) if is_yaml else b""
    if node in _FORMER_NODES:
        message += f"; nothing reads it below `{node.decode()}`, which is `behavior_server` since Humble"
    return Hit(
        "distribution.plugin_gone", message, line, context=change.name, path=path, edits=edits, change=change.key,
        certainty=Certainty.HEURISTIC if node in _FORMER_NODES else None,
    )  # fmt: skip


def _node_above(content: bytes, at: int) -> bytes:
    """Return the last part of the key without indentation that stands before a place of a parameter file."""
    keys = [match[1] for match in _TOP_KEY.finditer(content, 0, at)]
    return keys[-1].rpartition(b"/")[2] if keys else b""


@cache
def _names() -> re.Pattern[bytes]:
    """Return a pattern of the names as whole values: behind `: `, `- `, `[`, `,`, `>` or `name=`, quoted or not."""
    names = sorted((re.escape(one.encode()) for one in changes_of(Kind.PLUGIN)), key=len, reverse=True)
    return re.compile(
        rb"(?:[:\-\[,]\s+|\[|>\s*|\bname=)[\"']?(" + b"|".join(names) + rb")(?![\w:/])[\"']?\s*(?=[\n\r,\]<#>]|$)"
    )


RULE = PackageRule(
    id="distribution.plugin_gone",
    title="Plug-in that the distribution does not have under this name",
    finds="A value of a parameter file, or a text in a robot description, that is the name of a plug-in which a "
    "distribution of ROS does not have under it any more, by a dated table: `nav2_behaviors/Spin`, which is "
    "`nav2_behaviors::Spin` from Jazzy on. For which distributions a package is built, `distro` in roslens.toml or "
    "`--distro` says; otherwise files of continuous integration and containers do. What is gone in a later "
    "distribution where none is known is a note.",
    why="pluginlib finds no class of that name: the server does not configure, in that distribution only.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("distribution", "plugin"),
    fix="Writes the new name in parameter files where it takes the old one's place as it is.",
    bad="planner_server:\n  ros__parameters:\n    GridBased:\n      plugin: nav2_navfn_planner/NavfnPlanner",
    good="planner_server:\n  ros__parameters:\n    GridBased:\n      plugin: nav2_navfn_planner::NavfnPlanner",
    found=found,
)
