"""Rule ``launch.missing_container``: components are loaded into a container that is called otherwise."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Launched

_MENTIONS = (b"LoadComposableNodes", b"load_composable_node")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each component whose container a launch file does not start, where it starts another one."""
    said: set[tuple[str, int]] = set()
    for run in view.launch_runs:
        if not any(one in run.content for one in _MENTIONS) or any(one.opens for one in run.launch.unresolved):
            continue
        for node, message in _lost(run.launch.nodes):
            at = node.evidence
            if at.path in view.by_path and (at.path, at.line) not in said:
                said.add((at.path, at.line))
                yield Hit("launch.missing_container", message, at.line, at.column, context=message, path=at.path)


def _lost(nodes: tuple[Launched, ...]) -> Iterator[tuple[Launched, str]]:
    """Yield the components whose container is not started, unless the name of a container is unknown."""
    started = {_full_name(one) for one in nodes if _is_container(one)}
    if not started or "" in started:
        return
    for node in nodes:
        target = node.container.known
        if node.kind != "component" or not target:
            continue
        full = target if target.startswith("/") else _below(node.namespace.known or "/", target)
        if started.isdisjoint((full, f"/{target.lstrip('/')}")):
            yield node, _message(target, full, started)


def _message(target: str, full: str, started: set[str]) -> str:
    close = get_close_matches(full, started, 1, 0.5)
    expected = f"{close[0]!r}" if close else " or ".join(repr(one) for one in sorted(started)[:3])
    what = f"it is loaded into {target!r}, and the launch file starts no container of that name"
    return f"{what}: launch waits for it for ever; expected {expected}"


def _is_container(node: Launched) -> bool:
    executable = node.executable.known or ""
    return node.kind == "container" or executable.startswith("component_container")


def _full_name(node: Launched) -> str:
    name, space = node.name.known, node.namespace.known
    return _below(space, name) if name and space else ""


def _below(space: str, name: str) -> str:
    return f"{space.rstrip('/')}/{name}"


RULE = PackageRule(
    id="launch.missing_container",
    title="Container that is not started",
    finds="Components that a launch file of ROS 2 loads into a container of another name than those that it starts. "
    "Launch files that start no container, or include what is not known, are left out: another one may start it.",
    why="launch waits for the service of the container without end: the components never run, and nothing fails.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch",),
    bad='<node_container pkg="rclcpp_components" exec="component_container" name="box" namespace=""/>\n'
    '<load_composable_node target="/boxx"><composable_node pkg="base" plugin="base::Drive" name="drive"/>'
    "</load_composable_node>",
    good='<node_container pkg="rclcpp_components" exec="component_container" name="box" namespace=""/>\n'
    '<load_composable_node target="/box"><composable_node pkg="base" plugin="base::Drive" name="drive"/>'
    "</load_composable_node>",
    found=found,
)
