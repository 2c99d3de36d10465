"""Rule ``package.nested_control``: a ``<ros2_control>`` that stands where nobody reads it."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.elements import Element, read_elements

_TAG = "ros2_control"
_NO_ROBOT = frozenset({"gazebo", "link", "joint", "transmission", "plugin", _TAG})
"""Elements of a robot's description; those of xacro are gone when it is read."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each ``<ros2_control>`` inside of an element of a description that is not the robot."""
    for file in view.of_language(Language.URDF, Language.XACRO, roles=(Role.OWN,)):
        content = view.read(file.path)
        if f"<{_TAG}".encode() not in content:
            continue
        document = read_elements(content)
        if document.root is None or document.root.tag != "robot":
            continue
        waiting: list[tuple[Element, str]] = [(document.root, "")]
        while waiting:
            element, around = waiting.pop()
            if element.tag == _TAG and around:
                line, column = document.place(element.start)
                message = (
                    f"<{_TAG}> inside of <{around}>: the controller manager reads those directly below <robot> only, "
                    f"and finds no hardware here; expected it beside <{around}>"
                )
                yield Hit("package.nested_control", message, line, column, context=around, path=file.path)
                continue
            inside = element.tag if element.tag in _NO_ROBOT else around
            waiting.extend((child, inside) for child in reversed(element.elements()))


RULE = PackageRule(
    id="package.nested_control",
    title="Hardware of ros2_control inside of another element",
    finds="A `<ros2_control>` in a description of a robot (URDF, xacro) that stands inside of `<gazebo>`, `<link>`, "
    "`<joint>` or the like. Put it directly below `<robot>`; macros and conditions of xacro may be around it.",
    why="`hardware_interface` reads children of `<robot>` only: without one it ends with «no ros2_control tag», and "
    "otherwise the hardware is missing.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("configuration", "description"),
    bad='<robot name="arm">\n  <gazebo>\n    <ros2_control name="arm" type="system"/>\n  </gazebo>\n</robot>',
    good='<robot name="arm">\n  <ros2_control name="arm" type="system"/>\n  <gazebo/>\n</robot>',
    found=found,
)
