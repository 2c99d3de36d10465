"""Launch files in XML and YAML as rules see them: elements with attributes, and the substitutions in their texts."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from roslens.model.errors import DocumentError
from roslens.model.source import Language, Role
from roslens.source.rules.hit import Hit
from roslens.source.rules.views.package_files import PackageFiles

if TYPE_CHECKING:
    from roslens.source.extract.launch.launch_markup import Entity

_SUBSTITUTION = re.compile(r"(?<!\\)\$\(\s*([A-Za-z_][\w-]*)")
_ROS_1_ATTRIBUTES = {
    ("node", "type"): "exec",
    ("node", "ns"): "namespace",
    ("node", "required"): 'on_exit="shutdown"',
    ("node", "clear_params"): "",
    ("node", "machine"): "",
    ("include", "ns"): "<push-ros-namespace> in a <group> around it",
    ("include", "pass_all_args"): "",
    ("include", "clear_params"): "",
    ("group", "ns"): "<push-ros-namespace> in it",
    ("group", "clear_params"): "",
    ("param", "command"): "value with $(command …)",
    ("param", "textfile"): "from, or value with $(file-content …)",
    ("param", "binfile"): "",
    ("arg", "doc"): "description",
}
"""Attributes of roslaunch that launch of ROS 2 does not have, each with what it has instead."""
_ROS_1_ELEMENTS = {
    "rosparam": '<param from="…"/> in <node>',
    "machine": "",
    "test": "launch_testing",
    "master": "",
}
_ROS_1_OUTER = {"param": "<param> in <node>", "remap": "<set_remap> or <remap> in <node>", "env": "<set_env>"}
"""Elements that roslaunch takes outside of a node."""
ROS_1_SUBSTITUTIONS = {"arg": "$(var …)", "find": "$(find-pkg-share …)", "optenv": "$(env NAME default)"}
_ROS_2_SUBSTITUTIONS = frozenset({"var", "find-pkg-share", "find-pkg-prefix", "exec-in-pkg", "equals", "command"})
_ROS_2_ELEMENTS = frozenset({
    "let", "push-ros-namespace", "push_ros_namespace", "node_container", "load_composable_node", "set_parameter",
    "set_env", "set_remap", "executable", "timer", "composable_node",
})  # fmt: skip
_ROS_2_ATTRIBUTES = {("node", "exec"): "type", ("node", "namespace"): "ns", ("node", "ros_args"): "args"}


class LaunchMarkup:
    """A launch file in XML or YAML.

    Attributes:
        path: below the workspace.
    """

    def __init__(self, package: PackageFiles, path: str) -> None:
        """Take a file; nothing is read before it is asked for."""
        self._package = package
        self.path = path

    @cached_property
    def entities(self) -> tuple[Entity, ...]:
        """The outermost elements; none of a file that cannot be read, which is told elsewhere."""
        from roslens.source.extract.launch.launch_markup import read_entities

        try:
            return read_entities(self.path, self._package.read(self.path))
        except (DocumentError, RecursionError):
            return ()

    @cached_property
    def all(self) -> tuple[tuple[Entity, Entity | None], ...]:
        """All elements in order, each with the one around it."""
        found: list[tuple[Entity, Entity | None]] = []
        waiting: list[tuple[Entity, Entity | None]] = [(one, None) for one in reversed(self.entities)]
        while waiting:
            entity, around = waiting.pop()
            found.append((entity, around))
            waiting.extend((child, entity) for child in reversed(entity.children))
        return tuple(found)

    @cached_property
    def of_ros1(self) -> tuple[tuple[Entity, str, str], ...]:
        """What only roslaunch of ROS 1 has: where, what, and what launch of ROS 2 has instead."""
        return tuple(one for entity, around in self.all for one in _of_ros1(entity, around))

    @cached_property
    def of_ros2(self) -> tuple[tuple[Entity, str, str], ...]:
        """What only launch of ROS 2 has: where, what, and what roslaunch has instead."""
        return tuple(one for entity, _ in self.all for one in _of_ros2(entity))

    @property
    def is_of_ros1(self) -> bool:
        """Whether it is written for ROS 1 as a whole."""
        return bool(self.of_ros1) and not self.of_ros2

    def hit(self, rule: str, entity: Entity, message: str, context: str) -> Hit:
        """Return a hit at an element."""
        at = entity.evidence
        return Hit(rule, message, at.line, at.column, context=context, path=self.path)


def markup_files(package: PackageFiles) -> list[LaunchMarkup]:
    """Return the own launch files in XML and YAML of a package."""
    files = package.of_language(Language.LAUNCH_XML, Language.LAUNCH_YAML, roles=(Role.OWN,))
    return [LaunchMarkup(package, file.path) for file in files]


def substitutions_in(entity: Entity) -> Iterator[str]:
    """Yield the names of the substitutions in the attributes of an element, inner ones too."""
    for value in entity.attributes.values():
        yield from _SUBSTITUTION.findall(value)


def is_of_ros1(entity: Entity, attribute: str = "") -> bool:
    """Return whether an element, or an attribute of it, is one of ROS 1 alone."""
    return (entity.kind, attribute) in _ROS_1_ATTRIBUTES if attribute else entity.kind in _ROS_1_ELEMENTS


def _of_ros1(entity: Entity, around: Entity | None) -> Iterator[tuple[Entity, str, str]]:
    kind = entity.kind
    if kind in _ROS_1_ELEMENTS:
        yield entity, f"<{kind}>", _ROS_1_ELEMENTS[kind]
        return
    if kind in _ROS_1_OUTER and (around is None or around.kind == "group"):
        yield entity, f"<{kind}> outside of a node", _ROS_1_OUTER[kind]
    if kind == "arg" and "value" in entity.attributes and (around is None or around.kind == "group"):
        yield entity, f"{_tag(entity)} with a value", "<let>"
    for name in entity.attributes:
        if (kind, name) in _ROS_1_ATTRIBUTES:
            yield entity, f"{name}= of <{kind}>", _ROS_1_ATTRIBUTES[kind, name]
    for name in substitutions_in(entity):
        if name in ROS_1_SUBSTITUTIONS:
            yield entity, f"$({name} …)", ROS_1_SUBSTITUTIONS[name]


def _of_ros2(entity: Entity) -> Iterator[tuple[Entity, str, str]]:
    if entity.kind in _ROS_2_ELEMENTS:
        yield entity, f"<{entity.kind}>", ""
    for name in entity.attributes:
        if (entity.kind, name) in _ROS_2_ATTRIBUTES:
            yield entity, f"{name}= of <{entity.kind}>", _ROS_2_ATTRIBUTES[entity.kind, name]
    for name in substitutions_in(entity):
        if name in _ROS_2_SUBSTITUTIONS:
            yield entity, f"$({name} …)", {"var": "$(arg …)", "find-pkg-share": "$(find …)"}.get(name, "")


def _tag(entity: Entity) -> str:
    name = entity.attributes.get("name", "")
    return f'<{entity.kind} name="{name}">' if name else f"<{entity.kind}>"
