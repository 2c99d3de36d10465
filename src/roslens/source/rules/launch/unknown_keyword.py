"""Rule ``launch.unknown_keyword``: a keyword that the class of launch does not take."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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
    """Yield each keyword that no supported distribution has in the class that is called; those removed at once."""
    code = launch_code(view)
    for call in code.calls if code is not None else ():
        signature = call.signature
        if signature.is_open:
            continue
        unknown = [name for name in call.names if name not in signature.known]
        removed = [name for name in unknown if name in signature.keywords]
        for name in unknown:
            if name not in removed:
                message = _message(signature, call.name, (name,))
                yield view.hit("launch.unknown_keyword", call.names[name], message)
        if removed:
            # Nothing in the file says which distribution it is for: that which removed them, or an earlier one.
            message = _message(signature, call.name, removed)
            node = call.names[removed[0]]
            yield view.hit("launch.unknown_keyword", node, message, certainty=Certainty.LIKELY)


def _message(signature: Signature, called: str, names: Sequence[str]) -> str:
    several = len(names) > 1
    given = ", ".join(f"`{name}`" for name in names)
    expected = ", ".join(dict.fromkeys(_expected(signature, name) for name in names))
    span = signature.keywords.get(names[0])
    since = f" since {span.removed_in}, where {'they were' if several else 'it was'} removed" if span else ""
    word = "keywords" if several else "keyword"
    return f"`{called}` has no {word} {given}{since}: the launch ends with a TypeError; expected {expected}"


def _expected(signature: Signature, name: str) -> str:
    meant = _INSTEAD.get(name, "")
    if meant.partition("=")[0] not in signature.known:
        meant = next(iter(get_close_matches(name, signature.known, 1)), "")
    return f"`{meant}`" if meant else f"one of {', '.join(signature.known) or 'none'}"


RULE = FileRule(
    id="launch.unknown_keyword",
    title="Keyword that a class of launch does not have",
    finds="A keyword in a call of a class of `launch`, `launch_ros`, `launch_xml` or `launch_yaml` that no supported "
    "distribution has, such as `node_executable` and `node_name`, which Galactic removed, or a misspelt one. What only "
    "some of the supported distributions have is not reported, nor are calls of classes that are derived from these. "
    "Keywords that were removed are a warning, for a workspace may be for a distribution that had them still; those of "
    "one call are one finding.",
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
