"""Rule ``launch.parameter_entry``: a parameter written as an entry of a name and a value."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.launch.each_call import each_call
from roslens.source.rules.rule import FileRule
from roslens.source.rules.views.launch_code import MENTIONS, LaunchCall, LaunchCode, shown

_GIVEN = ("parameters", "extra_arguments")
_NAMES, _VALUES = frozenset({"name", "key"}), frozenset({"value"})
_FURTHER = frozenset({"type"})


def _judged(call: LaunchCall, code: LaunchCode) -> Iterator[tuple[Node, str]]:
    """Yield each dictionary of parameters that says the name of a parameter where its key should."""
    for given in _GIVEN:
        node = call.argument(given) if given in call.signature.keywords else None
        for one in code.items(node):
            pairs = {code.text(key): value for key, value in code.pairs(one)}
            name = next((pairs[key] for key in pairs if key in _NAMES), None)
            value = pairs.get("value")
            if name is None or value is None or not pairs.keys() <= _NAMES | _VALUES | _FURTHER:
                continue
            expected = f"`{{{shown(name, code, 40).strip('`')}: {shown(value, code, 40).strip('`')}}}`"
            keys = " and ".join(f"`{key}`" for key in pairs)
            yield (
                one,
                f"{shown(one, code)} sets parameters called {keys}, and not {shown(name, code)}; expected {expected}",
            )


RULE = FileRule(
    id="launch.parameter_entry",
    title="Parameter written as a name and a value",
    finds="A dictionary `{'name': …, 'value': …}` in `parameters` of a node. Its keys are the names of parameters: "
    "write `{name: value}`.",
    why="The node is given two parameters called `name` and `value`, which it does not know; the one that was meant "
    "keeps its default.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch", "parameters"),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch_ros.actions import Node\n\n"
    "drive = Node(package='base', executable='drive', parameters=[{'name': 'rate', 'value': 10}])",
    good="from launch_ros.actions import Node\n\n"
    "drive = Node(package='base', executable='drive', parameters=[{'rate': 10}])",
    found=each_call("launch.parameter_entry", _judged),
)
