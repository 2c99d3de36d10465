"""Rule ``node.exception_in_callback_python``: an exception that leaves a callback of rclpy."""

from __future__ import annotations

import builtins
import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_ENDS_ON_PURPOSE = re.compile(r"\b(SystemExit|KeyboardInterrupt|ExternalShutdownException|NotImplementedError)\b")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``raise`` in a callback of a subscription or timer, outside of any ``try``."""
    statement = node if node.type == "raise_statement" else node.parent
    if statement is None or statement.type != "raise_statement" or is_handled(statement):
        return
    raised = view.text(statement).removeprefix("raise").strip()
    name = re.match(r"\w+", raised)
    if (
        name is not None
        and not hasattr(builtins, name[0])
        and re.search(rb"\bexcept\b[^\n]*\b" + name[0].encode() + rb"\b", view.code)
    ):
        return
    callback = callback_around(statement, view, of_stream=True)
    if callback is not None and not _ENDS_ON_PURPOSE.search(raised):
        yield view.hit(
            "node.exception_in_callback_python",
            statement,
            f"`raise {shortened(raised, 60)}` leaves {spoken(callback)}, and `spin` with it: the node ends; expected "
            "it caught here, and said by a log line or a diagnostic",
            callback=callback,
        )


RULE = FileRule(
    id="node.exception_in_callback_python",
    title="Exception that leaves a callback (rclpy)",
    finds="`raise` in a callback of a subscription or timer with no `try` around. Handle it there.",
    why="The executor raises it again out of `spin`: one message that is not as expected ends the node.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2",),
    tags=("callbacks", "exceptions"),
    bad="import rclpy\nnode.create_subscription(Goal, 'goal', on, 10)\ndef on(goal):\n    raise ValueError('bad "
    "goal')\n",
    good="import rclpy\nnode.create_subscription(Goal, 'goal', on, 10)\ndef on(goal):\n    log.error('bad goal')\n",
    syntax="python",
    anchors=("raise",),
    mentions=RCLPY,
    spares_tests=True,
    found=found,
)
