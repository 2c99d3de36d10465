"""Rule ``node.exit_in_callback_python``: a callback of rospy that tries to end the process."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROSPY, FileRule

_EXITS = frozenset(("sys.exit", "exit", "quit", "os._exit"))


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call in a callback that raises SystemExit, or ends the process at once."""
    call = call_at(node)
    name = view.text(call.child_by_field_name("function")) if call is not None else ""
    if call is None or name not in _EXITS:
        return
    callback = callback_around(call, view)
    if callback is not None:
        does = "ends the process with nothing cleaned up" if name == "os._exit" else "ends this thread, not the node"
        yield view.hit(
            "node.exit_in_callback_python",
            call,
            f"`{view.text(call)}` in {spoken(callback)} {does}; expected `rospy.signal_shutdown(reason)`",
            callback=callback,
        )


RULE = FileRule(
    id="node.exit_in_callback_python",
    title="Callback that exits (rospy)",
    finds="`sys.exit()`, `exit()` or `quit()` in a callback. Call `rospy.signal_shutdown(reason)`.",
    why="Callbacks of rospy run in threads of their own: SystemExit ends that thread, the topic is never heard again, "
    "and "
    "the node stays.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("lifetime", "callbacks"),
    bad="import rospy\nrospy.Subscriber('stop', Empty, on_stop)\ndef on_stop(m):\n    sys.exit(0)\n",
    good="import rospy\nrospy.Subscriber('stop', Empty, on_stop)\ndef on_stop(m):\n    rospy.signal_shutdown('stop')\n",
    syntax="python",
    anchors=("exit", "quit", "_exit"),
    mentions=ROSPY,
    found=found,
)
