"""Rule ``launch.unknown_markup``: launch of ROS 2 does not have an element, attribute or substitution."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches
from typing import TYPE_CHECKING

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.signatures.read_markup import ANYWHERE, ElementSignature, part_of, read_markup
from roslens.source.rules.views.launch_markup import (
    ROS_1_SUBSTITUTIONS,
    LaunchMarkup,
    is_of_ros1,
    markup_files,
    substitutions_in,
)

if TYPE_CHECKING:
    from roslens.source.extract.launch.launch_markup import Entity

_Found = Iterator[tuple["Entity", str, str, bool]]
_INSTEAD = {
    "executable": "exec", "package": "pkg", "arguments": "args", "ns": "namespace", "type": "exec", "cmd": "exec",
    "parameters": "<param> in it", "remappings": "<remap> in it", "value": "default", "default_value": "default",
    "doc": "description", "target_container": "target", "condition": "if",
}  # fmt: skip
"""What is meant by the names that launch has for the same in Python, and by those of ROS 1."""
_SURE = 0.8
_LIKE = 0.66
"""How alike names of elements, and the shorter ones of substitutions, are to be taken for misspelt."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield what launch of ROS 2 refuses in the launch files in XML and YAML of a package for it."""
    if view.ros != frozenset({2}):
        return
    for file in markup_files(view):
        for entity, what, context, is_sure in () if file.is_of_ros1 else _in(file):
            hit = file.hit("launch.unknown_markup", entity, what, context)
            yield hit if is_sure else msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)


def _in(file: LaunchMarkup) -> _Found:
    waiting = [(one, read_markup().elements.get(one.kind)) for one in reversed(file.entities)]
    while waiting:
        entity, signature = waiting.pop()
        if signature is None:
            yield from () if is_of_ros1(entity) else _unknown_element(entity)
            continue
        yield from _attributes(entity, signature)
        yield from _substitutions(entity)
        for child in reversed(entity.children):
            known = part_of(signature, child.kind)
            if known is None and not _may_be_an_action(child, signature) and not is_of_ros1(child):
                yield from _unknown_child(child, entity, signature)
            else:
                waiting.append((child, known))


def _may_be_an_action(child: Entity, signature: ElementSignature) -> bool:
    return "*" in signature.children and child.kind not in read_markup().parts


def _unknown_element(entity: Entity) -> _Found:
    known = read_markup().elements
    close = get_close_matches(entity.kind, known, 1, _SURE)
    expected = f"<{close[0]}>" if close else "an element of it, unless another package provides this"
    what = f"launch has no element <{entity.kind}>, and refuses the file; expected {expected}"
    yield entity, what, entity.kind, bool(close)


def _unknown_child(child: Entity, around: Entity, signature: ElementSignature) -> _Found:
    inside = ", ".join(f"<{one.rpartition('.')[2]}>" for one in signature.children) or "nothing"
    what = f"<{child.kind}> in <{around.kind}>: launch refuses it there"
    yield child, f"{what}; expected {inside.replace('<*>', 'actions')} in it", child.kind, True


def _attributes(entity: Entity, signature: ElementSignature) -> _Found:
    for name in entity.attributes:
        if name in signature.attributes or name in ANYWHERE or name.startswith("xmlns") or ":" in name:
            continue
        if name.removesuffix("-sep") in signature.attributes or is_of_ros1(entity, name):
            continue
        meant = _INSTEAD.get(name, "")
        if not meant.startswith("<") and meant not in (*signature.attributes, *ANYWHERE):
            meant = next(iter(get_close_matches(name, signature.attributes, 1)), "")
        allowed = ", ".join(signature.attributes) or "none"
        expected = f"{meant}" if meant else f"one of {allowed}"
        what = f"<{entity.kind}> has no attribute {name!r}: launch refuses the file"
        yield entity, f"{what}; expected {expected}", name, True


def _substitutions(entity: Entity) -> _Found:
    known = read_markup().substitutions
    for name in dict.fromkeys(substitutions_in(entity)):
        # A command line of a shell has substitutions of its own.
        if name in known or name in ROS_1_SUBSTITUTIONS or "command" in substitutions_in(entity):
            continue
        close = get_close_matches(name, known, 1, _LIKE)
        expected = f"$({close[0]} …)" if close else "one of launch, unless another package provides this"
        yield entity, f"launch has no substitution $({name} …); expected {expected}", name, bool(close)


RULE = PackageRule(
    id="launch.unknown_markup",
    title="Element or attribute that launch does not have",
    finds="An element, attribute or substitution in a launch file in XML or YAML of ROS 2 that neither launch nor "
    "launch_ros has in a supported distribution, and an element where launch does not take it. What is like none of "
    "theirs is a note: another package may provide it.",
    why="launch refuses what it did not read: `ros2 launch` ends before anything starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    bad='<launch>\n  <node pkg="base" exec="drive" outptu="screen"/>\n</launch>',
    good='<launch>\n  <node pkg="base" exec="drive" output="screen"/>\n</launch>',
    found=found,
)
