"""The words of a command line as a program gets them, if a launch file contains them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.abstract_value import Unknown, Value
from roslens.source.extract.domain.kinds import known_text
from roslens.source.extract.domain.word_list import ROS_ARGS, Words, without_ros2
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.ir.program import Call, Member, Name, Program
from roslens.source.extract.symbolic.text import Hole, Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_READ = frozenset({"argv", "argc", "sys.argv", "myargv", "rospy.myargv", "parse_args", "parse_known_args",
                   "remove_ros_args"})  # fmt: skip
_OF_ROS = frozenset({"ros.init", "rclcpp.init", "rclpy.init"})
_STARTED = frozenset({"node", "test", "lifecycle", "container"})
_ASSIGNS = ":="
_FLAGS = frozenset({"-r", "--remap", "-p", "--param", "--params-file", "--log-level", "--log-config-file", "-e",
                    "--enclave", "--enable-rosout-logs", "--"})  # fmt: skip
"""What may stand behind ``--ros-args``."""


def words_of(launched: Launched, generation: str) -> tuple[Text, ...] | None:
    """Return the words that a node is started with; None where a part of them is unknown.

    roslaunch puts remappings, the name and the file of the log after what the launch file says (roslaunch, node_args.py
    and launch.py). launch_ros puts ``--ros-args`` there, and behind it names, remappings and files of parameters
    (launch_ros, actions/node.py): they are for ROS alone, so these words end with it.
    """
    if launched.kind not in _STARTED or any(one.holes for one in launched.arguments):
        return None
    if generation != "ros1":
        return Text((Hole("path of the program"),)), *launched.arguments, Text.of(ROS_ARGS)
    remaps = (Text.of(one.source, _ASSIGNS, one.target) for one in launched.remaps)
    name = Text.of("__name:=", launched.name)
    log = Text.of("__log:=", Hole("file of the log"))
    return Text((Hole("path of the program"),)), *launched.arguments, *remaps, name, log


def reads_words(program: Program) -> bool:
    """Return whether a program does more with its command line than to give it to ROS."""
    waiting: list[object] = [(*one.parameters, *one.initialisers, *one.body) for one in program.functions]
    waiting.append(program.body)
    while waiting:
        one = waiting.pop()
        match one:
            case tuple():
                waiting += one
            case Name() | Member() if one.name in _READ:
                return True
            case Call() if _written(one.function) in _OF_ROS:
                continue
            case msgspec.Struct():
                waiting += msgspec.structs.astuple(one)
    return False


def _written(function: object) -> str:
    """Return what is called as written, of names and members of names."""
    match function:
        case Member(of=Name(name=of), name=name):
            return f"{of}.{name}"
        case Name(name=name):
            return name
    return ""


def without_ros(words: Sequence[Value]) -> Words:
    """Return words without those that are for ROS 1: remappings, private parameters, and what begins with ``__``."""
    return Words(one for one in words if not _is_assignment(one))


def _is_assignment(word: Value) -> bool:
    match word:
        case Text(pattern=pattern):
            return _ASSIGNS in pattern
    return False


def given_to_ros(ctx: Context, called: CallSite) -> None:
    """Take what is for ROS from the words that ``ros::init(argc, argv, …)`` is given, as it does."""
    words = called.given(Words, 1)
    if words is not None and called.written:
        words[:] = without_ros(words)
        ctx.assign(called.written[0], len(words))


@outer("ros.removeROSArgs")
def remove_ros_args(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The words that are not for ROS are put into a list."""
    words = called.given(Words, 1)
    if words is not None and len(called.written) > 2:
        ctx.assign(called.written[2], without_ros(words))
    return None


@outer("rospy.myargv", quiet=True)
def my_words(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The words that are not for ROS."""
    match called.argument(0, "argv", default=ctx.given.words):
        case Words() as words:
            return without_ros(words)
    return Unknown("result of rospy.myargv()")


@outer("rclpy.utilities.remove_ros_args", "rclpy.remove_ros_args", "rclcpp.remove_ros_arguments",
       "rclcpp.init_and_remove_ros_arguments", quiet=True)  # fmt: skip
def of_program(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The words that are not for ROS 2."""
    words = called.argument(1 if "rclcpp" in called.name else 0, "args")
    match ctx.given.words if words is None else words:
        case Words() as known:
            return without_ros2(known)
    return Unknown(f"result of {called.name}()")


@outer("rcutils_cli_option_exist", quiet=True)
def option_given(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Whether a word is among those of the command line."""
    words, option = called.given(Words, 0), called.argument(2)
    place = None if words is None else _place(words, option)
    return Unknown(f"whether {option} is given") if place is None else place >= 0


@outer("rcutils_cli_get_option", quiet=True)
def option_value(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The word after an option; nothing where it is not given."""
    words, option = called.given(Words, 0), called.argument(2)
    place = None if words is None else _place(words, option)
    if place is None or words is None or (place >= 0 and not words.has(place + 1)):
        return Unknown(f"the value of {option}")
    found: Value = words[place + 1] if place >= 0 else None
    return found


def _place(words: Words, option: Value) -> int | None:
    """Return where an option is among words, -1 where it is not; None where that is unknown."""
    known = known_text(option)
    if not known:
        return None
    texts = [known_text(one) for one in words]
    if known in texts:
        return texts.index(known)
    # The first word is the path of the program.
    return None if None in texts[1:] or (words.goes_on and known in _FLAGS) else -1


@outer("len", quiet=True)
def count(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """How many words there are; other lists may have become longer in a way that was not followed."""
    words = called.given(Words, 0)
    return Unknown("result of len()") if words is None else words.length


@outer("strcmp", "std.strcmp", quiet=True)
def compared(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Two texts are compared: 0 where they are the same."""
    one, other = (known_text(value) for value in (*called.arguments, None, None)[:2])
    return Unknown("result of strcmp()") if one is None or other is None else (one > other) - (one < other)
