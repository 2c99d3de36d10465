"""Rule ``node.endless_loop_python``: a loop in rospy that no shutdown ends."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import LOOPS, body_of, is_handled
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ENDS = re.compile(
    rb"\b(break|return|raise|exit|_exit|is_shutdown|is_preempt_requested|yield|await|set_trace|breakpoint)\b|"
    rb"(?<![\w.])(?:raw_)?input\s*\(|(?<!time)\.sleep\s*\(|wait_for_message|rospy\.Rate"
)

_INITIALISED = re.compile(rb"^[^#\n]*\binit_node\b", re.MULTILINE)
"""Without it, rospy leaves Ctrl-C to the process."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop without a condition that neither leaves itself nor sleeps by rospy, which raises at shutdown."""
    loop = node
    while loop.parent is not None and loop.type not in LOOPS:
        loop = loop.parent
    body = body_of(loop)
    if is_handled(loop) and not _is_interrupt_alone(loop, view):
        return
    if _INITIALISED.search(view.code) is None:
        return
    if loop.type not in LOOPS or body is None or _ENDS.search(view.code[body.start_byte : body.end_byte]):
        return
    if _ends_with_the_process(loop, view):
        return
    yield view.hit(
        "node.endless_loop_python",
        node,
        f"`{view.text(loop).partition(':')[0]}` never ends: nothing in it leaves it or asks `rospy.is_shutdown()`; "
        "expected "
        "`while not rospy.is_shutdown():`",
    )


def _ends_with_the_process(loop: Node, view: FileView) -> bool:
    """Return whether a loop runs in a thread that ends with the process.

    That is a timer of rospy, one that is a daemon, or one of a process that ends by ``os._exit``, which waits for none.
    """
    function = above(loop, "function_definition")
    name = re.escape(view.text(function.child_by_field_name("name")).encode()) if function is not None else b""
    handed = rb"\b(Timer|Thread)\s*\([^\n]*\b" + name + rb"\b(?!\s*\()"
    found = re.search(handed, view.code) if name else None
    if found is None:
        return False
    if found[1] == b"Timer" or b"aemon" in view.code:
        return True
    called = rb"(?<!def )\b" + name + rb"\s*\("
    return b"os._exit(" in view.code and re.search(called, view.code) is None


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
    "the process running until it is killed.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("lifetime",),
    bad="import rospy\nrospy.init_node('n')\nwhile True:\n    work()\n",
    good="import rospy\nrospy.init_node('n')\nwhile not rospy.is_shutdown():\n    work()\n",
    syntax="python",
    anchors=("while True", "while 1", "while(True)", "while(1)"),
    mentions=("init_node",),
    found=found,
)
