"""Rule ``launch.unknown_keyword``: a keyword that the class of launch does not take."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import Signature
from roslens.source.rules.views.launch_code import MENTIONS, launch_code

_INSTEAD = {
    "node_executable": "executable",
    "node_name": "name",
    "node_namespace": "namespace",
    "node_plugin": "plugin",
    "pkg": "package",
    "package_name": "package",
    "exec": "executable",
    "exe": "executable",
    "ns": "namespace",
    "args": "arguments",
    "remap": "remappings",
    "params": "parameters",
    "param": "parameters",
    "default": "default_value",
    "launch_prefix": "prefix",
    "launch-prefix": "prefix",
    "required": "on_exit=Shutdown()",
    "if_condition": "condition",
    "ros_args": "ros_arguments",
}
"""What is meant by names of earlier versions, of ROS 1 and of launch files in XML."""


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each keyword that no supported distribution has in the class that is called."""
    code = launch_code(view)
    for call in code.calls if code is not None else ():
        for name, node in call.names.items():
            if call.signature.is_open or name in call.signature.known:
                continue
            yield view.hit("launch.unknown_keyword", node, _message(call.signature, call.name, name))


def _message(signature: Signature, called: str, name: str) -> str:
    span = signature.keywords.get(name)
    since = f" since {span.removed_in}, where it was removed" if span is not None else ""
    meant = _INSTEAD.get(name, "")
    if meant.partition("=")[0] not in signature.known:
        meant = next(iter(get_close_matches(name, signature.known, 1)), "")
    allowed = ", ".join(signature.known) or "none"
    expected = f"`{meant}`" if meant else f"one of {allowed}"
    return f"`{called}` has no keyword `{name}`{since}: the launch ends with a TypeError; expected {expected}"


RULE = FileRule(
    id="launch.unknown_keyword",
    title="Keyword that a class of launch does not have",
    finds="A keyword in a call of a class of `launch`, `launch_ros`, `launch_xml` or `launch_yaml` that no supported "
    "distribution has, such as `node_executable` and `node_name`, which Galactic removed, or a misspelt one. What only "
    "some of the supported distributions have is not reported, nor are calls of classes that are derived from these.",
    why="Python raises a TypeError while the launch file is read: nothing starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch_ros.actions import Node\n\nnode = Node(package='base', node_executable='drive')",
    good="from launch_ros.actions import Node\n\nnode = Node(package='base', executable='drive')",
    found=found,
)
