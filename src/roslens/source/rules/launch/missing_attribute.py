"""Rule ``launch.missing_attribute``: an element of a launch file of ROS 2 lacks what launch requires."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.signatures.read_markup import ElementSignature, part_of, read_markup
from roslens.source.rules.views.launch_markup import LaunchMarkup, markup_files

if TYPE_CHECKING:
    from roslens.source.extract.launch.launch_markup import Entity


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each element without a required attribute."""
    if view.ros != frozenset({2}):
        return
    for file in markup_files(view):
        for entity, message in () if file.is_of_ros1 else _in(file):
            yield file.hit("launch.missing_attribute", entity, message, message[:60])


def _in(file: LaunchMarkup) -> Iterator[tuple[Entity, str]]:
    known: dict[int, ElementSignature | None] = {}
    for entity, around in file.all:
        outer = known.get(id(around)) if around is not None else None
        signature = read_markup().elements.get(entity.kind) if around is None else outer and part_of(outer, entity.kind)
        known[id(entity)] = signature
        if signature is None:
            continue
        missing = [name for name in signature.required if name not in entity.attributes]
        others = [name for name in entity.attributes if name not in signature.attributes]
        if missing and not others:
            names = " and ".join(missing)
            yield entity, f"<{entity.kind}> without {names}: launch refuses the file; expected {_shown(signature)}"
        elif signature.name == "param" and (what := _of_param(entity)):
            yield entity, what


def _of_param(entity: Entity) -> str:
    """Return what is wrong about a parameter: it needs a file, or a name with a value."""
    names = entity.attributes.keys()
    if "from" in names and "name" in names:
        return "<param> with both from and name: launch refuses the file; expected one of them"
    if "from" in names:
        return ""
    if "name" not in names:
        return "<param> with neither name nor from: launch refuses the file; expected one of them"
    if "value" not in names and not entity.children:
        return f"<param name={entity.attributes['name']!r}> without a value: launch refuses the file; expected value="
    return ""


def _shown(signature: ElementSignature) -> str:
    attributes = " ".join(f'{one}="…"' for one in signature.required)
    return f"<{signature.name.rpartition('.')[2]} {attributes}>"


RULE = PackageRule(
    id="launch.missing_attribute",
    title="Element without what launch requires",
    finds="An element in a launch file in XML or YAML of ROS 2 without an attribute that launch requires: `exec` of "
    "`<node>`, `file` of `<include>`, `name` and `namespace` of `<node_container>`, `name` of `<composable_node>`; "
    "and a `<param>` without a value.",
    why="launch refuses the file: `ros2 launch` ends before anything starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    bad='<launch>\n  <node pkg="base" name="drive"/>\n</launch>',
    good='<launch>\n  <node pkg="base" exec="drive" name="drive"/>\n</launch>',
    found=found,
)
