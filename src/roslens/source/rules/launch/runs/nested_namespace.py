"""Rule ``launch.nested_namespace``: a namespace is added to itself, or to that of what was started before."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Launched
    from roslens.source.extract.facts.node_facts import Evidence
    from roslens.source.rules.views.launch_runs import LaunchRun

_MENTIONS = (b"namespace", b"Namespace")
_RESERVED = "ros_namespace"
"""The configuration in which launch_ros keeps the namespace that is pushed: `PushRosNamespace`, `Node` and the like."""
_GIVEN = re.compile(
    rb"(?:namespace\s*=\s*|PushRosNamespace\(\s*)LaunchConfiguration\(\s*['\"]ros_namespace['\"]"
    rb"|namespace\s*=\s*\"[^\"]*\$\(var\s+ros_namespace\s*\)"
)


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each node that a launch file starts in namespaces that pile up, once for each place."""
    said: set[tuple[str, int]] = set()
    for run in view.launch_runs:
        if not any(one in run.content for one in (*_MENTIONS, b"nclude")):
            continue
        yield from _reserved(run, view)
        for at, message in (*_growing(run.launch.nodes), *_doubled(run.launch.nodes)):
            if at.path in view.by_path and (at.path, at.line) not in said:
                said.add((at.path, at.line))
                yield Hit("launch.nested_namespace", message, at.line, at.column, context=message, path=at.path)


def _reserved(run: LaunchRun, view: PackageView) -> Iterator[Hit]:
    """Yield the argument that is called like the namespace of launch_ros, and is given to a node or pushed."""
    if not _GIVEN.search(run.content):
        return
    for action in run.actions:
        if action.kind == "argument" and action.values.get("name") == _RESERVED and run.path in view.by_path:
            message = (
                f"the argument '{_RESERVED}' is what launch_ros takes for the namespace of every node: given to a node "
                "or pushed again it is there twice; expected another name, such as 'namespace'"
            )
            at = action.evidence
            yield Hit("launch.nested_namespace", message, at.line, at.column, context=_RESERVED, path=run.path)


def _growing(nodes: tuple[Launched, ...]) -> Iterator[tuple[Evidence, str]]:
    """Yield the place of nodes that are started several times, each time below the namespace of the time before."""
    by_place: dict[tuple[str, int, int], list[Launched]] = {}
    for node in nodes:
        by_place.setdefault((node.evidence.path, node.evidence.line, node.evidence.column), []).append(node)
    for same in by_place.values():
        for one, other in pairwise(same):
            before, after = one.namespace.known, other.namespace.known
            if before and after and before != "/" and after.startswith(f"{before}/"):
                what = f"this is started in {before}, and the next time in {after}"
                why = "a namespace that is pushed outside of a group stays for what is started next"
                yield one.evidence, f"{what}: {why}; expected a group around it"
                break


def _doubled(nodes: tuple[Launched, ...]) -> Iterator[tuple[Evidence, str]]:
    """Yield the place of each node whose namespace has the same part twice, one after the other."""
    for node in nodes:
        parts = (node.namespace.known or "").split("/")
        twice = next((one for one, other in pairwise(parts) if one and one == other), "")
        if twice:
            what = f"this is started in {node.namespace.known}, which has {twice!r} twice"
            yield node.evidence, f"{what}: it is pushed, and given again; expected one of both"


RULE = PackageRule(
    id="launch.nested_namespace",
    title="Namespaces that pile up",
    finds="A node that launch files of ROS 2 start in a namespace below the one it was started in before, because "
    "`push-ros-namespace` or `PushRosNamespace` stands outside of a group in an included file; and a namespace with "
    "the same part twice, which is pushed around the node and given to it again; and an argument `ros_namespace`, "
    "which launch_ros takes for the namespace of every node, given to a node or pushed again. Launch files are "
    "evaluated with the defaults of their arguments.",
    why="The second robot talks in `/r1/r2`: nobody listens there, and nothing says so.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch",),
    bad='<launch>\n  <push-ros-namespace namespace="$(var robot)"/>\n  <node pkg="base" exec="drive"/>\n</launch>',
    good='<launch>\n  <group>\n    <push-ros-namespace namespace="$(var robot)"/>\n    <node pkg="base" exec="drive"/>'
    "\n  </group>\n</launch>",
    found=found,
)
