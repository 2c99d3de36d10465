"""Rule ``launch.braces``: a substitution of launch in braces or brackets, which stays as it is."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.rules.views.launch_view import LaunchXml
    from roslens.source.workspace.elements import Element

_WRITTEN = re.compile(
    r"\$(?:\{|\[)\s*((?:arg|var|find|find-pkg-share|find-pkg-prefix|env|optenv|anon|eval|dirname)(?:\s+[^{}\[\]$]*)?)(?:\}|\])"
)
_BARE = frozenset({"dirname"})
"""Substitutions without a value; of others that have none, a name of xacro is meant."""
_COMMANDS = frozenset({"args", "command", "launch-prefix", "cmd"})
"""Attributes that a shell or xacro reads in the end."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each substitution that is written in braces, once for each attribute."""
    for file in view.launch:
        if not file.is_test and _WRITTEN.search(file.text):
            for element, _ in file.elements:
                yield from _in_braces(file, element)


def _in_braces(file: LaunchXml, element: Element) -> Iterator[Hit]:
    for key, value in element.attributes.items():
        match = _WRITTEN.search(value) if key not in _COMMANDS else None
        if match is not None and (" " in match[1] or match[1] in _BARE):
            message = (
                f"{key} has `{match[0]}`, which launch does not replace: these letters are the value; expected "
                f"`$({match[1].strip()})`"
            )
            yield file.hit("launch.braces", element, message, match[0])


RULE = PackageRule(
    id="launch.braces",
    title="Substitution in braces",
    finds="A substitution of launch in braces or brackets, `${arg name}`, `${find package}`, `$[var name]`, in an "
    "attribute of a launch file in XML. Launch knows `$(arg name)` only; braces are those of xacro and of a shell.",
    why="The letters are handed on as they are: a node opens a file or a folder called `${arg name}`, and the argument "
    "changes nothing.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("launch",),
    bad='<param name="folder" value="${arg folder}"/>',
    good='<param name="folder" value="$(arg folder)"/>',
    found=found,
)
