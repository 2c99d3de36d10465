"""Rule ``launch.undefined_name``: a launch file uses a name that it neither imports nor defines."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import homes_of
from roslens.source.rules.views.launch_code import MENTIONS, LaunchCode, launch_code
from roslens.source.rules.views.python_names import above_of, text_of

_ELSEWHERE = {
    "get_package_share_directory": "ament_index_python.packages",
    "get_package_share_path": "ament_index_python.packages",
    "get_package_prefix": "ament_index_python.packages",
    "MoveItConfigsBuilder": "moveit_configs_utils",
    "RewrittenYaml": "nav2_common.launch",
    "Path": "pathlib",
}
_MODULES = frozenset({"os", "sys", "yaml", "xacro", "json", "math", "launch", "launch_ros", "pathlib", "datetime"})
_WAYS = ("if_statement", "for_statement", "while_statement", "try_statement", "except_clause", "conditional_expression")
"""What runs only sometimes."""


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first use of each name that nothing binds."""
    code = launch_code(view)
    said: set[str] = set()
    for node in code.names.unbound() if code is not None else ():
        name = text_of(node)
        if code is None or name in said:
            continue
        said.add(name)
        certainty = None if _is_always_read(node) else Certainty.LIKELY
        message = f"`{name}` is not defined: a NameError where this is read; expected {_expected(name, code)}"
        yield view.hit("launch.undefined_name", node, message, certainty=certainty)


def _is_always_read(node: Node) -> bool:
    """Whether a name is read whenever the file is launched."""
    function = above_of(node, "function_definition", "lambda")
    is_entry = function is None or text_of(function.child_by_field_name("name")) == "generate_launch_description"
    return is_entry and above_of(node, *_WAYS) is None


def _expected(name: str, code: LaunchCode) -> str:
    homes = homes_of(name)
    home = homes[0] if homes else _ELSEWHERE.get(name, "")
    if home:
        return f"`from {home} import {name}`"
    if name in _MODULES:
        return f"`import {name}`"
    known = {one for scope in code.names.scopes.values() for one in scope.bound} - {name}
    close = get_close_matches(name, sorted(known), 1)
    return f"`{close[0]}`, or its definition" if close else "its import or definition"


RULE = FileRule(
    id="launch.undefined_name",
    title="Name that a launch file does not define",
    finds="A name in a launch file in Python that is neither imported nor bound around it, nor a builtin. "
    "It is a warning where a condition or another function may keep it from being read. Files with "
    "`import *`, `exec` or `globals()` are left out.",
    why="Python raises a NameError at that line: nothing starts, or not on the day that the branch is taken.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    clauses=("ruff F821",),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch import LaunchDescription\n\n\ndef generate_launch_description():\n"
    "    return LaunchDescription([Node(package='base', executable='drive')])",
    good="from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([Node(package='base', executable='drive')])",
    found=found,
)
