"""Rule ``node.spin_missing_python``: a program in Python that subscribes and ends at once."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule
from roslens.source.rules.run_code import run_code

_NEEDS_SPIN = re.compile(rb"\b(Subscriber|create_subscription|create_service|create_timer|Service)\b\s*\(")
_STAYS = re.compile(
    rb"[sS]pin|\bwhile\b|[sS]leep|[wW]ait|mainloop|exec_?\b|\binput\b|raw_input|[rR]un|join\s*\(|[lL]oop|Executor|execute|"
    rb"unittest|rostest|\.main\s*\(|\.start\s*\(|\bshow\s*\(|serve|pause\s*\(|interact|embed\s*\(|\blaunch\s*\(|listen\s*\("
)

_STATEMENT = re.compile(rb"^[ \t]*([A-Za-z_][\w.]*)\(", re.MULTILINE)
_PROGRAM = frozenset(("expression_statement", "if_statement", "try_statement", "with_statement"))
_RETURNS = re.compile(
    rb"print|exit|publish|append|add\w*|set\w*|update|info|warn(?:ing)?|error|debug|fatal|__init__|super|log\w+|"
    rb"Subscriber|Publisher|Service|Timer|create_\w+|destroy_\w+|shutdown|declare_parameters?|registerCallback|write|"
    rb"close|get\w*|insert|extend|sendTransform|advertise"
)
"""Names of what returns at once."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the beginning of a program that subscribes, in a file in which nothing waits."""
    call = call_at(node)
    if call is None or (not view.mentions((b"__main__",)) and not view.mentions((b"def main",))):
        return
    if _NEEDS_SPIN.search(view.code) is None or _STAYS.search(view.code) or _may_stay_elsewhere(call, view):
        return
    # Of a file that cannot be parsed nobody knows what runs.
    registers = None if view.root.has_error else _NEEDS_SPIN.search(run_code(view))
    if registers is None:
        return
    is_rospy = view.text(node) == "init_node"
    yield view.hit(
        "node.spin_missing_python",
        call,
        f"the program makes `{registers[1].decode()}` and nothing in this file spins or waits: it ends at once; "
        "expected " + ("`rospy.spin()`" if is_rospy else "`rclpy.spin(node)`"),
    )


def _may_stay_elsewhere(call: Node, view: FileView) -> bool:
    """Return whether a statement of the program calls what another file defines and is not known to return at once.

    Those of the function in which the node begins are looked at, and those outside of functions.
    """
    function = function_around(call)
    inside = view.code[function.start_byte : function.end_byte] if function is not None else view.code
    outside = b"\n".join(view.code[one.start_byte : one.end_byte] for one in view.root.children if one.type in _PROGRAM)
    for match in _STATEMENT.finditer(inside + b"\n" + outside):
        *of, name = match[1].split(b".")
        if of[:1] in ([b"rospy"], [b"rclpy"], [b"sys"], [b"logging"], [b"parser"]) or _RETURNS.fullmatch(name):
            continue
        if not re.search(rb"\b(?:def|class)\s+" + re.escape(name) + rb"\b", view.code):
            return True
    return False


RULE = FileRule(
    id="node.spin_missing_python",
    title="Program that never spins (Python)",
    finds="A program that makes a subscription, service or timer, in a file in which nothing spins or waits. Spin. "
    "What no code of the file's top level or `main` comes to is left out.",
    why="The program ends at once, and with it the node; under a launch that respawns it, it comes and goes.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="import rospy\ndef main():\n    rospy.init_node('n')\n    rospy.Subscriber('x', String, f)\n",
    good="import rospy\ndef main():\n    rospy.init_node('n')\n    rospy.Subscriber('x', String, f)\n    "
    "rospy.spin()\n",
    syntax="python",
    anchors=("init_node", "rclpy.init"),
    mentions=ROS_PYTHON,
    found=found,
)
