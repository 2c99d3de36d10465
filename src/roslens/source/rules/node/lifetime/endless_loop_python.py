"""Rule ``node.endless_loop_python``: a loop in rospy that no shutdown ends."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.calls import LOOPS, body_of, is_handled
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ENDS = re.compile(
    rb"\b(break|return|raise|exit|_exit|is_shutdown|is_preempt_requested|yield|await)\b|rospy\.sleep|[rR]ate\.sleep|"
    rb"wait_for_message|rospy\.Rate"
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop without a condition that neither leaves itself nor sleeps by rospy, which raises at shutdown."""
    loop = node
    while loop.parent is not None and loop.type not in LOOPS:
        loop = loop.parent
    body = body_of(loop)
    if is_handled(loop) and not _is_interrupt_alone(loop, view):
        return
    if loop.type not in LOOPS or body is None or _ENDS.search(view.code[body.start_byte : body.end_byte]):
        return
    yield view.hit(
        "node.endless_loop_python",
        node,
        f"`{view.text(loop).partition(':')[0]}` never ends: nothing in it leaves it or asks `rospy.is_shutdown()`; "
        "expected "
        "`while not rospy.is_shutdown():`",
    )


def _is_interrupt_alone(loop: Node, view: FileView) -> bool:
    """Tell whether the handlers around a loop wait for Ctrl-C alone, which rospy never lets through."""
    around = above(loop, "try_statement")
    clauses = [one for one in around.children if one.type == "except_clause"] if around is not None else []
    return bool(clauses) and all("Interrupt" in view.text(one).partition(":")[0] for one in clauses)


RULE = FileRule(
    id="node.endless_loop_python",
    title="Loop that no shutdown ends (rospy)",
    finds="`while True` in a node of rospy, without a way out, a look at `is_shutdown()` or a sleep of rospy, which "
    "raises "
    "at shutdown. Ask `rospy.is_shutdown()`.",
    why="rospy takes Ctrl-C and the launch's signal away from the process and raises no KeyboardInterrupt: the loop "
    "keeps "
    "the process until somebody kills it.",
    profiles=("ros1",),
    tags=("lifetime",),
    bad="import rospy\nrospy.init_node('n')\nwhile True:\n    work()\n",
    good="import rospy\nrospy.init_node('n')\nwhile not rospy.is_shutdown():\n    work()\n",
    syntax="python",
    anchors=("while True", "while 1", "while(True)", "while(1)"),
    mentions=("init_node",),
    found=found,
)
