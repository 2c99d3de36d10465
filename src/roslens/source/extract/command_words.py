"""The words of a command line as a program gets them, where a launch file says them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import msgspec

from roslens.source.extract.abstract_value import Unknown
from roslens.source.extract.launched import Launched
from roslens.source.extract.program import Call, Member, Name, Program
from roslens.source.extract.text import Hole, Text
from roslens.source.extract.vocabulary import Called, outer

if TYPE_CHECKING:
    from roslens.source.extract.evaluation import Evaluation

_READ = frozenset({"argv", "argc", "sys.argv", "myargv", "rospy.myargv"})
_OF_ROS = frozenset({"ros.init"})
_ASSIGNS = ":="


class Words(list[Any]):
    """The words of a command line, that of the program first: a list of which nothing is missing."""


def words_of(launched: Launched, generation: str) -> tuple[Text, ...] | None:
    """Return the words that a node is started with; None where a part of them is unknown.

    Those of ROS 1 only: roslaunch puts remappings, the name and the file of the log after what the launch file says
    (roslaunch, node_args.py and launch.py).
    """
    if generation != "ros1" or launched.kind not in ("node", "test") or any(one.holes for one in launched.arguments):
        return None
    remaps = (Text.of(one.source, _ASSIGNS, one.target) for one in launched.remaps)
    name = Text.of("__name:=", launched.name)
    log = Text.of("__log:=", Hole("file of the log"))
    return Text((Hole("path of the program"),)), *launched.arguments, *remaps, name, log


def reads_words(program: Program) -> bool:
    """Return whether a program does more with its command line than to give it to ROS."""
    waiting: list[object] = [one.initialisers + one.body for one in program.functions]
    waiting.append(program.body)
    while waiting:
        one = waiting.pop()
        if isinstance(one, tuple):
            waiting += one
        elif isinstance(one, Name | Member) and one.name in _READ:
            return True
        elif isinstance(one, msgspec.Struct):
            if isinstance(one, Call) and isinstance(one.function, Name) and one.function.name in _OF_ROS:
                continue
            waiting += [getattr(one, name) for name in one.__struct_fields__]
    return False


def without_ros(words: Sequence[Any]) -> Words:
    """Return words without those that are for ROS 1: remappings, private parameters, and what begins with ``__``."""
    return Words(one for one in words if not (isinstance(one, Text) and _ASSIGNS in one.pattern))


def given_to_ros(engine: Evaluation, called: Called) -> None:
    """Take what is for ROS from the words that ``ros::init(argc, argv, …)`` is given, as it does."""
    words = called.argument(1)
    if isinstance(words, Words) and called.written:
        words[:] = without_ros(words)
        engine.assign(called.written[0], len(words))


@outer("ros.removeROSArgs")
def remove_ros_args(engine: Evaluation, _thing: Any, called: Called) -> Any:
    """The words that are not for ROS are put into a list."""
    words = called.argument(1)
    if isinstance(words, Words) and len(called.written) > 2:
        engine.assign(called.written[2], without_ros(words))
    return None


@outer("rospy.myargv", quiet=True)
def my_words(engine: Evaluation, _thing: Any, called: Called) -> Any:
    """The words that are not for ROS."""
    words = called.argument(0, "argv", default=engine.words)
    return without_ros(words) if isinstance(words, Words) else Unknown("result of rospy.myargv()")


@outer("len", quiet=True)
def count(_engine: Evaluation, _thing: Any, called: Called) -> Any:
    """How many words there are; other lists may have become longer in a way that was not followed."""
    words = called.argument(0)
    return len(words) if isinstance(words, Words) else Unknown("result of len()")


@outer("strcmp", "std.strcmp", quiet=True)
def compared(_engine: Evaluation, _thing: Any, called: Called) -> Any:
    """Two texts are compared: 0 where they are the same."""
    one, other = (value.known if isinstance(value, Text) else None for value in (*called.arguments, None, None)[:2])
    return Unknown("result of strcmp()") if one is None or other is None else (one > other) - (one < other)
