"""Rule ``launch.unlaunched_action``: an action is made and nobody launches it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import ACTION, HANDLER
from roslens.source.rules.views.launch_code import MENTIONS, launch_code
from roslens.source.rules.views.python_names import above_of, text_of


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each action that is assigned to a name that is never read, and each that is not kept at all."""
    code = launch_code(view)
    if code is None or code.names.is_open:
        return
    read = {text_of(node) for node, _ in code.names.reads}
    for call in code.calls:
        parent = call.node.parent
        if parent is None or call.signature.kind not in (ACTION, HANDLER):
            continue
        left = parent.child_by_field_name("left") if parent.type == "assignment" else None
        name = text_of(left) if left is not None and left.type == "identifier" else ""
        if name and name not in read and parent.child_by_field_name("right") == call.node:
            certainty = Certainty.HEURISTIC if _is_set_aside(name, view) else None
            yield view.hit("launch.unlaunched_action", call.node, _message(name, call.name), certainty=certainty)
        elif parent.type == "expression_statement" and above_of(call.node, "function_definition") is not None:
            what = f"`{call.name}(…)` is made and kept nowhere: it is never launched"
            yield view.hit("launch.unlaunched_action", call.node, f"{what}; expected it in the LaunchDescription")


def _is_set_aside(name: str, view: FileView) -> bool:
    """Whether a comment or text of the file has the name: somebody took it out of the description on purpose."""
    places = re.findall(rb"(?<!\w)%s(?!\w)" % re.escape(name.encode()), view.content)
    return len(places) > 1 or name.startswith("_")


def _message(name: str, made: str) -> str:
    what = f"`{name}`, a {made}, is made and never used: it is not launched"
    return f"{what}; expected it in the LaunchDescription, or nothing"


RULE = FileRule(
    id="launch.unlaunched_action",
    title="Action that is never launched",
    finds="An action or event handler that a launch file in Python assigns to a name that is never read, or makes and "
    "keeps nowhere. It is a note where a comment of the file has the name: it was taken out of the description.",
    why="The node does not start, the argument does not exist, the variable is not set; nothing says so.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    drive = Node(package='base', executable='drive')\n"
    "    return LaunchDescription([])",
    good="from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    drive = Node(package='base', executable='drive')\n"
    "    return LaunchDescription([drive])",
    found=found,
)
