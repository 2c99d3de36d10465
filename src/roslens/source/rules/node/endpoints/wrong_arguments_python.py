"""Rule ``node.wrong_arguments_python``: arguments that the functions of an rclpy node do not take."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import msgspec
from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, keywords, receiver
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_TYPE, _NAME, _CALLBACK, _QOS, _PERIOD = "msg_type", "topic", "callback", "qos_profile", "timer_period_sec"
_LOGGER = "get_logger"
_TAKES: Mapping[str, Sequence[str]] = {
    "create_publisher": (_TYPE, _NAME, _QOS),
    "create_subscription": (_TYPE, _NAME, _CALLBACK, _QOS),
    "create_service": ("srv_type", "srv_name", _CALLBACK),
    "create_client": ("srv_type", "srv_name"),
    "create_timer": (_PERIOD, _CALLBACK),
    _LOGGER: (),
}
"""Arguments that have to be given, in their order, as in rclpy/node.py since Foxy."""
_MOST = {"create_timer": 5}
"""Of arguments by position, where more are taken than have to be given."""
_ROS1 = frozenset({"queue_size", "latch", "callback_args", "tcp_nodelay", "buff_size", "data_class"})
"""Keywords of rospy that rclpy does not have."""
_EXPECTED = {
    _TYPE: "the class of the message",
    "srv_type": "the class of the service",
    _NAME: "the name as text",
    "srv_name": "the name as text",
    _CALLBACK: "a function",
    _QOS: "a depth or a QoSProfile",
    _PERIOD: "seconds",
}
_TEXTS = ("string", "concatenated_string")
_NUMBERS = ("integer", "float")
_REFUSED = {
    _TYPE: (*_TEXTS, *_NUMBERS, "lambda"),
    "srv_type": (*_TEXTS, *_NUMBERS, "lambda"),
    _NAME: (*_NUMBERS, "lambda"),
    "srv_name": (*_NUMBERS, "lambda"),
    _CALLBACK: (*_TEXTS, *_NUMBERS),
    _QOS: (*_TEXTS, "float", "lambda", "none"),
    _PERIOD: (*_TEXTS, "lambda"),
}
"""Types of nodes that an argument cannot be: rclpy raises TypeError, or fails at the first call."""
_DEFINED = re.compile(rb"\bdef\s+(\w+)\b")
_MADE_NODES = re.compile(rb"\b(\w+)\s*=\s*[\w.]*(?:create_node|Node)\(")
_DERIVED = re.compile(rb"\bclass\s+(\w+)\s*\(\s*(?:rclpy\.node\.)?Node\s*\)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call with an argument too few, too many, of another kind, or of rospy."""
    call, name = call_at(node), view.text(node)
    if call is None or not _is_node(receiver(call), view) or name.encode() in view.names(_DEFINED):
        return
    given, named = arguments(call), keywords(call, view)
    takes = _TAKES[name]
    if "**" in named or any(one.type in ("list_splat", "dictionary_splat") for one in given):
        return
    problem = _problem(name, given, named, takes, view)
    if problem:
        hit = view.hit(
            "node.wrong_arguments_python",
            call,
            f"`{name}` {problem}",
            certainty=None if _is_own_node(call, view) else Certainty.LIKELY,
        )
        # What is logged is logged when something has happened: the node does start.
        yield msgspec.structs.replace(hit, consequence=Consequence.WRONG) if name == _LOGGER else hit


def _problem(name: str, given: Sequence[Node], named: Mapping[str, Node], takes: Sequence[str], view: FileView) -> str:
    """Return what is wrong with the arguments and what is expected; empty where nothing is."""
    of_rospy = sorted(_ROS1 & named.keys())
    if of_rospy:
        return f"has no argument `{of_rospy[0]}`, which is rospy's; expected `{', '.join(takes)}`"
    if len(given) > _MOST.get(name, len(takes)):
        if name == _LOGGER:
            return "takes no argument, and one is given; expected a method of what it returns: `get_logger().info(…)`"
        return f"takes {_MOST.get(name, len(takes))} arguments by position, and {len(given)} are given"
    missing = [one for one in takes[len(given) :] if one not in named]
    if missing and (given or named):
        return f"is called without `{missing[0]}`; expected {_EXPECTED[missing[0]]} there: `{', '.join(takes)}`"
    for wanted, one in (*zip(takes, given, strict=False), *((key, named[key]) for key in takes if key in named)):
        if _is_refused(one, wanted, view):
            return f"takes `{wanted}` where `{view.text(one)[:60]}` stands; expected {_EXPECTED[wanted]}"
    return ""


def _is_refused(one: Node, wanted: str, view: FileView) -> bool:
    if one.type in _REFUSED[wanted]:
        return True
    if wanted in (_QOS, _PERIOD):
        return _is_function(one, view) or (wanted == _QOS and _is_object_of_this_file(one, view))
    return False


def _is_function(one: Node, view: FileView) -> bool:
    """Return whether it is the name of a function of this file, and of nothing else."""
    text = view.text(one)
    name = text.removeprefix("self.")
    if one.type not in ("identifier", "attribute") or not name.isidentifier():
        return False
    defined = name.encode() in view.names(_DEFINED)
    # A property is a value, and a name that is set is one, too.
    return defined and not re.search(
        rf"@[\w.]*property\s+def\s+{name}\b|\b{name}\s*(?::[^=\n]*)?=[^=]".encode(), view.code
    )


def _is_object_of_this_file(one: Node, view: FileView) -> bool:
    """Return whether it is a variable that is set once, to an object of a class of this file without a base."""
    name = view.text(one)
    if one.type != "identifier":
        return False
    values = re.findall(rf"\b{name}\s*=\s*(\w+)\(".encode(), view.code)
    if len(values) != 1 or len(re.findall(rf"\b{name}\b\s*(?::[^=\n]*)?=[^=]".encode(), view.code)) != 1:
        return False
    if re.search(rf"\bdef\s+\w+\([^)]*\b{name}\b".encode(), view.code):
        around = above(one, "function_definition")
        if around is None or re.search(rf"\b{name}\b", view.text(around.child_by_field_name("parameters"))):
            return False
    return (
        re.search(rb"^class\s+" + values[0] + rb"\s*(?:\(\s*(?:object)?\s*\))?\s*:", view.code, re.MULTILINE)
        is not None
    )


def _is_node(one: Node | None, view: FileView) -> bool:
    """Return whether an object is the one around, called a node, or made as one in this file."""
    name = view.text(one)
    if name == "self" or "node" in name.lower():
        return True
    return name.isidentifier() and (name.encode() in view.names(_MADE_NODES) or _is_of_own_class(name, view))


def _is_of_own_class(name: str, view: FileView) -> bool:
    """Return whether a name is only given objects of a class of this file that is derived from rclpy's node."""
    values = re.findall(rf"\b{name}\s*=\s*([^\n]*)".encode(), view.code)
    derived = view.names(_DERIVED)
    return bool(values) and all(one.partition(b"(")[0] in derived for one in values)


def _is_own_node(call: Node, view: FileView) -> bool:
    """Return whether the call is one of a class that is derived from rclpy's node alone."""
    around = above(call, "class_definition")
    bases = view.text(around.child_by_field_name("superclasses")) if around is not None else ""
    if view.text(receiver(call)) != "self" or bases not in ("(Node)", "(rclpy.node.Node)"):
        return False
    return bases != "(Node)" or re.search(rb"from\s+rclpy\.node\s+import\b[^\n]*\bNode\b", view.code) is not None


RULE = FileRule(
    id="node.wrong_arguments_python",
    title="Arguments that rclpy does not take",
    finds="A call of `create_publisher`, `create_subscription`, `create_service`, `create_client` or `create_timer` "
    "without an argument that has to be given, with one too many, with a keyword of rospy (`queue_size`, "
    "`callback_args` …), or with a text, a number or a function where something else is needed: type and name "
    "changed round, an argument for the callback in the place of the QoS.",
    why="The call raises TypeError: the node ends at start. Where it stands in a branch, it ends when that is reached.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("endpoints",),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.goals = self.create_subscription(Goal, 'goal', self.on_goal)
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        self.goals = self.create_subscription(Goal, 'goal', self.on_goal, 10)
""",
    syntax="python",
    anchors=tuple(_TAKES),
    mentions=RCLPY,
    spares_tests=True,
    found=found,
)
