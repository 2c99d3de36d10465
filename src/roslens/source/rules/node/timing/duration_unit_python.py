"""Rule ``node.duration_unit_python``: a number in one unit, given to what takes another, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, keywords, whole_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.timing.duration_unit import of_rate
from roslens.source.rules.node.timing.unit_of_name import SPOKEN, unit_of_name
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_TAKES: Mapping[str, str] = {
    "rospy.Duration": "s",
    "rospy.Duration.from_sec": "s",
    "rospy.sleep": "s",
    "rospy.Rate": "Hz",
    "time.sleep": "s",
    "create_rate": "Hz",
    "create_timer": "s",
}
"""The unit of the first argument, by whole name or, for methods of a node, by the last part of it."""
_KEYWORDS: Mapping[str, str] = {"timer_period_sec": "s", "seconds": "s", "nanoseconds": "ns"}
_METHODS = frozenset({"create_rate", "create_timer"})
_PLAIN = re.compile(r"(?:int\(|float\()?((?:\w+\.)*\w+)\)?")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a variable whose name ends in a unit, given as it is to what takes another one."""
    call = call_at(node)
    if call is None:
        return
    whole = view.text(whole_name(node))
    last = view.text(node)
    takes = _TAKES.get(last if last in _METHODS else whole, "")
    given = [(takes, one) for one in arguments(call)[:1]]
    given += [(_KEYWORDS[key], one) for key, one in keywords(call, view).items() if key in _KEYWORDS]
    for unit, one in given:
        plain = _PLAIN.fullmatch(view.text(one))
        said = unit_of_name(plain[1].replace(".", "::")) if plain is not None else ""
        if not unit or not said or said == unit or plain is None:
            continue
        if certainty := of_rate(plain[1], unit, view):
            expected = f"`1.0 / {plain[1]}`" if (said, unit) in (("Hz", "s"), ("s", "Hz")) else "a conversion"
            yield view.hit(
                "node.duration_unit_python",
                one,
                f"`{whole}` takes {SPOKEN[unit]}, and `{plain[1]}` is in {SPOKEN[said]} by its name; expected "
                f"{expected}, or a name that says the unit",
                certainty=certainty,
            )


RULE = FileRule(
    id="node.duration_unit_python",
    title="Duration in another unit than its name says (Python)",
    finds="A variable whose name ends in a unit (`timeout_ms`, `period_sec`) or in `rate` or `frequency`, given as it "
    "is to what takes another unit: `create_timer(self.rate, …)`, `rospy.sleep(timeout_ms)`, "
    "`rospy.Rate(period_sec)`, `Duration(seconds=loop_rate)`. Convert it. A period that is called a rate is none, if "
    "its first value in the file is less than 8; where the file has no value, a rate is a note.",
    why="A timeout of 500 ms is one of 500 s, and a rate of 10 Hz taken for a period is once in 10 s: the robot waits, "
    "or reacts too late.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="import rclpy\n\n\ndef start(node, rate):\n    node.create_timer(rate, node.step)\n",
    good="import rclpy\n\n\ndef start(node, rate):\n    node.create_timer(1.0 / rate, node.step)\n",
    syntax="python",
    anchors=("create_timer", "create_rate", "Duration", "from_sec", "sleep", "Rate"),
    mentions=ROS_PYTHON,
    found=found,
)
