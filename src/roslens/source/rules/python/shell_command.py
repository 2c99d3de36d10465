"""Rule ``python.shell_command``: a shell runs what a program put together."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_RUNS = frozenset({"call", "run", "Popen", "check_call", "check_output", "getoutput", "system", "popen"})
_FIXED = frozenset({"string", "concatenated_string", "list", "true", "false", "none"})

_OF_NUMBERS = re.compile(r"""^['"].*['"]\.format\([\w.\[\]]*\bpid\)$""")
"""A text that holds nothing but the number of a process."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a command for a shell that holds anything but text."""
    attribute = node.parent
    call = attribute.parent if attribute is not None else None
    if attribute is None or call is None or attribute.type != "attribute" or call.type != "call":
        return
    function = view.text(attribute)
    arguments = call.child_by_field_name("arguments")
    if (
        arguments is None
        or call.child_by_field_name("function") != attribute
        or function.rpartition(".")[2] not in _RUNS
    ):
        return
    given = [child for child in arguments.children if child.is_named and child.type != "comment"]
    is_shell = function in ("os.system", "os.popen", "subprocess.getoutput") or any(
        one.type == "keyword_argument" and view.text(one) in ("shell=True", "shell = True") for one in given
    )
    first = next((one for one in given if one.type not in ("keyword_argument", "list_splat")), None)
    if not is_shell or first is None or not _is_made(first, view):
        return
    message = f"{function} has a shell run {view.short(first)!r}; expected a list of arguments, without a shell"
    yield view.hit("python.shell_command", call, message)


def _is_made(node: Node, view: FileView) -> bool:
    if node.type == "string":
        return any(child.type == "interpolation" for child in node.children)
    if node.type == "identifier" and view.text(node).isupper():
        return False
    if node.type == "conditional_expression":
        first, _, other = (*node.named_children, node, node)[:3]
        return _is_made(first, view) or _is_made(other, view)
    if node.type == "call" and _OF_NUMBERS.search(view.text(node)):
        return False
    return node.type not in _FIXED


RULE = FileRule(
    id="python.shell_command",
    title="Command of a shell put together by a program",
    finds="`os.system`, `os.popen` and `subprocess` with `shell=True` whose command is not a plain text. Give "
    "`subprocess.run` a list of arguments.",
    why="A space in a file name, or a parameter or message from the network, becomes another command, with the "
    "rights of the robot.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    anchors=("system", "popen", "subprocess"),
    clauses=("bandit B602", "bandit B605", "ruff S602", "ruff S605"),
    bad='os.system("rosbag record -O " + name)',
    good='subprocess.run(["rosbag", "record", "-O", name], check=True)',
    spares_tests=True,
    found=found,
)
