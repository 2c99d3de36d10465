"""Rule ``launch.unlaunched_action``: an action is made and nobody launches it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import ACTION, HANDLER
from roslens.source.rules.views.launch_code import MENTIONS, launch_code
from roslens.source.rules.views.python_names import above_of, text_of

_TARGETS = frozenset({"target_action", "target_lifecycle_node"})
"""Parameters of event handlers that name whose events they are of."""


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each action that is assigned to a name that is never read, and each that is not kept at all."""
    code = launch_code(view)
    if code is None or code.names.is_open:
        return
    read = {text_of(node) for node, _ in code.names.reads}
    waited_for = read - {text_of(node) for node, _ in code.names.reads if not _is_waited_for(node)}
    for call in code.calls:
        if call.signature.kind not in (ACTION, HANDLER):
            continue
        name = _kept_as(call.node)
        if name and name not in read:
            # A comment or text has the name: somebody took it out of the description on purpose.
            certainty = Certainty.HEURISTIC if _words(view)[name.encode()] > 1 or name.startswith("_") else None
            yield view.hit("launch.unlaunched_action", call.node, _message(name, call.name), certainty=certainty)
        elif name and name in waited_for:
            what = (
                f"`{name}`, a {call.name}, is waited for by an event handler and never launched: the handler never runs"
            )
            yield view.hit(
                "launch.unlaunched_action", call.node, f"{what}; expected it in the LaunchDescription as well"
            )
        elif name is None:
            what = f"`{call.name}(…)` is made and kept nowhere: it is never launched"
            yield view.hit("launch.unlaunched_action", call.node, f"{what}; expected it in the LaunchDescription")


def _is_waited_for(node: Node) -> bool:
    """Return whether a name is read to wait for its events only."""
    around = node.parent
    if around is None:
        return False
    if around.type == "keyword_argument" and around.child_by_field_name("value") == node:
        return text_of(around.child_by_field_name("name")) in _TARGETS
    call = around.parent
    function = call.child_by_field_name("function") if call is not None and around.type == "argument_list" else None
    return text_of(function).rpartition(".")[2] == "matches_action"


def _kept_as(call: Node) -> str | None:
    """Return the name that a call is assigned to; empty where it is part of something, None where it is dropped."""
    parent = call.parent
    if parent is None or parent.type not in ("assignment", "expression_statement"):
        return ""
    if parent.type == "expression_statement":
        return None if above_of(call, "function_definition") is not None else ""
    left = parent.child_by_field_name("left")
    is_right = parent.child_by_field_name("right") == call
    return text_of(left) if left is not None and left.type == "identifier" and is_right else ""


def _words(view: FileView) -> Counter[bytes]:
    """Return how often each word stands in a file, comments and texts included; counted once."""
    kept = view.kept.get(_words)
    if not isinstance(kept, Counter):
        kept = view.kept[_words] = Counter(re.findall(rb"\w+", view.content))
    return kept


def _message(name: str, made: str) -> str:
    what = f"`{name}`, a {made}, is made and never used: it is not launched"
    return f"{what}; expected it in the LaunchDescription, or nothing"


RULE = FileRule(
    id="launch.unlaunched_action",
    title="Action that is never launched",
    finds="An action or event handler that a launch file in Python assigns to a name that is never read, or makes and "
    "keeps nowhere, and one that only event handlers wait for, which then never run. "
    "It is a note where a comment of the file has the name: it was taken out of the description; so is one whose "
    "program another launch file of the workspace starts.",
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
