"""Rule ``launch.unknown_attribute``: an attribute that roslaunch does not know."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.elements import Element

_ALWAYS = frozenset({"if", "unless"})
_NODE = frozenset({
    "pkg", "type", "machine", "name", "args", "output", "respawn", "respawn_delay", "cwd", "launch-prefix", "required",
    "ns", "clear_params",
})  # fmt: skip
_KNOWN = {
    "node": _NODE,
    "test": _NODE | {"test-name", "time-limit", "retry"},
    "include": frozenset({"file", "ns", "clear_params", "pass_all_args"}),
    "param": frozenset({"name", "value", "textfile", "binfile", "command", "type", "ns"}),
    "rosparam": frozenset({"command", "ns", "file", "param", "subst_value"}),
    "arg": frozenset({"name", "value", "default", "doc"}),
    "group": frozenset({"ns", "clear_params", "name"}),
    "remap": frozenset({"from", "to"}),
    "env": frozenset({"name", "value"}),
}
"""What roslaunch's reader of XML accepts (roslaunch/xmlloader.py), and the name of a group, which does no harm."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each attribute in a launch file of ROS 1 that roslaunch ignores."""
    if view.ros != frozenset({1}):
        return
    for file in view.launch:
        if file.is_test or "$(var " in file.text or " exec=" in file.text or "find-pkg-share" in file.text:
            continue
        for element, _ in file.elements:
            for name, message in _ignored(element):
                yield file.hit("launch.unknown_attribute", element, message, name)


def _ignored(element: Element) -> Iterator[tuple[str, str]]:
    """Yield the attributes of an element that roslaunch does not know, each with what is said of it."""
    known = _KNOWN.get(element.tag)
    if known is None:
        return
    for name in element.attributes:
        if name not in known and name not in _ALWAYS and ":" not in name:
            close = get_close_matches(name, known, 1)
            advice = f"; meant {close[0]!r}?" if close else f"; expected {', '.join(sorted(known))}"
            yield name, f"<{element.tag}> has no attribute {name!r}: roslaunch ignores it{advice}"


RULE = PackageRule(
    id="launch.unknown_attribute",
    title="Attribute that roslaunch does not know",
    finds="An attribute of `<node>`, `<include>`, `<param>`, `<rosparam>`, `<arg>`, `<group>`, `<remap>`, `<env>` "
    "or `<test>` that roslaunch does not have, in packages for ROS 1.",
    why='roslaunch prints a line among others and goes on: `requried="true"` lets the robot drive without the node '
    "that it cannot do without.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("launch",),
    bad='<node pkg="base" type="drive" name="drive" requried="true"/>',
    good='<node pkg="base" type="drive" name="drive" required="true"/>',
    found=found,
)
