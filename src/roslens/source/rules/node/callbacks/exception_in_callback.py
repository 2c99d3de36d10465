"""Rule ``node.exception_in_callback``: an exception that leaves a callback."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_MEANT = re.compile(r"//.*\b(?:shut|terminat|abort|exit|end|stop|kill)", re.IGNORECASE)
"""A comment that says that the node is to end."""
_LINES = 3


def _is_meant(statement: Node, view: FileView) -> bool:
    row = statement.start_point.row
    near = b"\n".join(view.lines[max(0, row - _LINES) : row + 1]).decode("utf-8", "replace")
    return _MEANT.search(near) is not None


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``throw`` in a callback of a subscription or timer, outside of any ``try`` and handler."""
    statement = node if node.type == "throw_statement" else node.parent
    if statement is None or statement.type != "throw_statement" or is_handled(statement):
        return
    if len(view.text(statement)) <= len("throw;"):
        return
    callback = callback_around(statement, view, of_stream=True)
    if callback is not None:
        thrown = re.sub(r"\(.*", "(...)", view.text(statement).removeprefix("throw").strip(" ;"))
        yield view.hit(
            "node.exception_in_callback",
            statement,
            f"`{thrown}` leaves {spoken(callback)}: the executor does not catch it and the process ends; expected it "
            "caught here, and said by a log line or a diagnostic",
            callback=callback,
            certainty=Certainty.HEURISTIC if _is_meant(statement, view) else None,
        )


RULE = FileRule(
    id="node.exception_in_callback",
    title="Exception that leaves a callback",
    finds="`throw` in a callback of a subscription or timer with no `try` around. Handle it there. Where a comment "
    "says that the node is to end, it is a note.",
    why="Nobody above catches it: one message that is not as expected ends the process, and in a container all nodes "
    "in it.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "exceptions"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::on_goal(const Goal::SharedPtr goal) { if (!goal->ok) throw std::runtime_error("bad goal"); }
void Arm::start() { sub_ = create_subscription<Goal>("goal", 10, std::bind(&Arm::on_goal, this, _1)); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::on_goal(const Goal::SharedPtr goal) { if (!goal->ok) { RCLCPP_ERROR(get_logger(), "bad goal"); return; } }
void Arm::start() { sub_ = create_subscription<Goal>("goal", 10, std::bind(&Arm::on_goal, this, _1)); }
""",
    syntax="cpp",
    anchors=("throw",),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
