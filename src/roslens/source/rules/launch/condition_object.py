"""Rule ``launch.condition_object``: something that is no condition is given as one."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.launch.each_call import each_call
from roslens.source.rules.rule import FileRule
from roslens.source.rules.views.launch_code import CLASS, MENTIONS, NOTHING, LaunchCall, LaunchCode

_TAKES_TEXT = frozenset({"IfCondition", "UnlessCondition"})
_HAS_NO_EVALUATE = "has no method `evaluate`, and the launch ends when it comes to this action"


def _judged(call: LaunchCall, code: LaunchCode) -> Iterator[tuple[Node, str]]:
    """Yield each ``condition=`` that is no condition, and each condition made of something else than a text."""
    yield from _given(call, code)
    yield from _made(call, code)


def _given(call: LaunchCall, code: LaunchCode) -> Iterator[tuple[Node, str]]:
    """Yield the condition of an action or component where it is something else."""
    node = call.keywords.get("condition")
    sort = code.sort(node)
    if node is None or call.signature.kind == "substitution" or sort in ("", "condition", NOTHING):
        return
    written = " ".join(code.view.text(node).split())[:60]
    if sort == CLASS:
        yield node, f"the condition is the class `{written}`, not an object of it; expected `{written}(…)`"
    else:
        yield node, f"`{written}` is no condition: it {_HAS_NO_EVALUATE}; expected `IfCondition({written})`"


def _made(call: LaunchCall, code: LaunchCode) -> Iterator[tuple[Node, str]]:
    """Yield what a condition is made of where that is neither a text nor a substitution."""
    node = call.argument("predicate_expression") if call.name in _TAKES_TEXT else None
    value = code.value(node)
    sort = code.sort(node)
    if node is None or value is None:
        return
    written = " ".join(code.view.text(value).split())[:60]
    if value.type in ("comparison_operator", "not_operator", "boolean_operator") and _compares(value, code):
        instead = "`EqualsSubstitution`, `NotSubstitution` or `PythonExpression`"
        what = f"`{written}` compares the object of a substitution, not its value, while the file is read"
        yield node, f"{what}: {call.name} of a bool is a TypeError; expected {instead}"
    elif sort in ("bool", "number", "None", "condition", "dict"):
        kind = f"a {sort}" if sort != "None" else "None"
        yield node, f"{call.name} of `{written}` is a TypeError: it is {kind}; expected a text or a substitution"


def _compares(node: Node, code: LaunchCode) -> bool:
    return any(code.is_substitution(one) for one in node.named_children)


RULE = FileRule(
    id="launch.condition_object",
    title="Something else where launch needs a condition",
    finds="`condition=` with a text, a bool, a substitution or a class instead of an object such as `IfCondition(…)`; "
    "and `IfCondition` or `UnlessCondition` of a bool, a number, another condition or a comparison of substitutions, "
    "which Python evaluates at once.",
    why="launch calls `evaluate` of it and ends with an AttributeError; a condition of a bool is a TypeError.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n\n"
    "rviz = Node(package='rviz2', executable='rviz2', condition=LaunchConfiguration('use_rviz'))",
    good="from launch.conditions import IfCondition\nfrom launch.substitutions import LaunchConfiguration\n"
    "from launch_ros.actions import Node\n\n"
    "rviz = Node(package='rviz2', executable='rviz2', condition=IfCondition(LaunchConfiguration('use_rviz')))",
    found=each_call("launch.condition_object", _judged),
)
