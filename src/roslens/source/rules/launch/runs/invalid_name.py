"""Rule ``launch.invalid_name``: a launch file of ROS 2 gives a node a name or namespace that rcl refuses."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Launched

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_NAMESPACE = re.compile(r"(?:/|(?:/[A-Za-z_][A-Za-z0-9_]*)+/?)\Z")
_KINDS = frozenset({"node", "lifecycle", "container", "component"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each node whose name or namespace is known and refused, once for each place."""
    said: set[tuple[str, int, str]] = set()
    for run in view.launch_runs:
        for node in run.launch.nodes if b"name" in run.content else ():
            at = node.evidence
            for what, text in _wrong(node) if at.path in view.by_path else ():
                if (at.path, at.line, what) not in said:
                    said.add((at.path, at.line, what))
                    message = f"{what} {text!r} of a node: {_reason(text)}; expected letters, digits and `_` in it"
                    yield Hit("launch.invalid_name", message, at.line, at.column, context=text, path=at.path)


def _wrong(node: Launched) -> Iterator[tuple[str, str]]:
    """Yield the name and the namespace of a node where rcl refuses them."""
    name, namespace = node.name.known, node.namespace.known
    if node.kind in _KINDS and name and not _NAME.match(name):
        yield "name", name
    if node.kind in _KINDS and namespace and not _NAMESPACE.match(namespace):
        yield "namespace", namespace


def _reason(text: str) -> str:
    if text != text.strip():
        return "a blank stands at its end, which rcl refuses" if text[-1:].isspace() else "it begins with a blank"
    bad = next((one for one in text if not (one.isalnum() or one in "_/")), "")
    if bad:
        return f"rcl refuses {bad!r}"
    return "rcl refuses a part that begins with a digit, is empty, or a name with `/`"


RULE = PackageRule(
    id="launch.invalid_name",
    title="Name of a node that rcl refuses",
    finds="A name or namespace that a launch file of ROS 2 gives a node and that has a blank, a hyphen, a dot or "
    "another sign that names may not have, begins with a digit, or, of a name, has a slash. Launch files are "
    "evaluated with the defaults of their arguments.",
    why='launch ends with "Invalid node name" before it starts the node.',
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    bad='<node pkg="base" exec="drive" name="left-drive"/>',
    good='<node pkg="base" exec="drive" name="left_drive"/>',
    found=found,
)
