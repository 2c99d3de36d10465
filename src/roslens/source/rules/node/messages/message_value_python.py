"""Rule ``node.message_value_python``: a field of a message set to a value of another kind."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, is_handled, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_messages import PythonMessages, python_messages
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule
from roslens.source.rules.signatures.read_messages import fields_of

_FLOATS = frozenset({"float", "double"})
_ITEMS = re.compile(r"^(?:sequence<(\w+)(?:,\d+)?>|(\w+)\[\d+\])$")
_WHOLE, _REAL, _TEXT, _TRUTH, _NOTHING, _TIME = "a whole number", "a float", "a text", "a bool", "None", "a time"
_LITERALS = {
    "integer": _WHOLE,
    "float": _REAL,
    "string": _TEXT,
    "concatenated_string": _TEXT,
    "true": _TRUTH,
    "false": _TRUTH,
    "none": _NOTHING,
}
_CALLS = {"int": _WHOLE, "len": _WHOLE, "float": _REAL, "str": _TEXT, "bool": _TRUTH, "time.time": _REAL}
_TAKEN = {"boolean": (_TRUTH,), "string": (_TEXT,)}
_NEEDED = {"boolean": "True or False", "string": "a text"}
_NOW = re.compile(r"(?:get_clock\(\)|\bClock\(\)|\bclock)\.now\(\)$")
_STAMP = "builtin_interfaces/Time"


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each value that a field of a message of a known type cannot hold."""
    messages = python_messages(view)
    if not messages.imported or b"rospy" in view.words:
        return
    for field, value, kind in (*_assigned(messages, view), *_by_keyword(messages, view)):
        given = _kind(value, view)
        expected = _expected(kind, value, given, view)
        if expected and not is_handled(value):
            what = f"`{field}` is {_shown(kind)} and is given {_given(given, value, view)}"
            yield view.hit("node.message_value_python", value, f"{what}; expected {expected}")


def _assigned(messages: PythonMessages, view: FileView) -> Iterator[tuple[str, Node, str]]:
    """Yield each field that is assigned, with the value and the type of the field."""
    for attribute in view.nodes("attribute"):
        assigned = attribute.parent
        value = assigned.child_by_field_name("right") if assigned is not None else None
        if assigned is None or assigned.type != "assignment" or value is None:
            continue
        fields = fields_of(messages.type_of(attribute.child_by_field_name("object")))
        name = view.text(attribute.child_by_field_name("attribute"))
        if assigned.child_by_field_name("left") == attribute and fields is not None and name in fields.types:
            yield view.text(attribute), value, fields.types[name]


def _by_keyword(messages: PythonMessages, view: FileView) -> Iterator[tuple[str, Node, str]]:
    """Yield each field that is given where a message is made."""
    for call in python_functions(view).calls:
        fields = fields_of(messages.type_of(call))
        for name, value in keywords(call, view).items() if fields is not None else ():
            if fields is not None and name in fields.types:
                yield name, value, fields.types[name]


def _kind(value: Node, view: FileView) -> str:
    """Return which kind of value an expression is; empty where that is not certain."""
    if value.type == "unary_operator" and value.named_children:
        return _kind(value.named_children[0], view) if view.text(value)[:1] in "+-" else ""
    if value.type == "call":
        callee = view.text(value.child_by_field_name("function"))
        if _NOW.search(view.text(value)):
            return _TIME
        return "" if python_functions(view).defines(callee) else _CALLS.get(callee, "")
    if value.type == "string" and view.text(value).lower().startswith(("b", "rb")):
        return ""
    return _LITERALS.get(value.type, "")


def _expected(kind: str, value: Node, given: str, view: FileView) -> str:
    """Return what is expected in a field; empty where it takes what it is given."""
    if given == _TIME:
        return f"`{view.text(value)}.to_msg()`" if kind == _STAMP else ""
    items = _ITEMS.match(kind)
    if items is not None:
        return _expected_items(items[1] or items[2], value, given, view)
    if not given or given in _taken(kind):
        return ""
    if "/" in kind:
        return f"an object of {_shown(kind)}"
    return _as_float(value, view) if kind in _FLOATS else _NEEDED.get(kind, "a whole number")


def _taken(kind: str) -> tuple[str, ...]:
    """Return the kinds of values that a field takes."""
    if kind in _FLOATS:
        return (_REAL,)
    if "int" in kind and "/" not in kind:
        return (_WHOLE, _TRUTH)
    return _TAKEN.get(kind, () if "/" in kind else (_WHOLE, _REAL, _TEXT, _TRUTH, _NOTHING))


def _expected_items(kind: str, value: Node, given: str, view: FileView) -> str:
    """Return what is expected as a list; empty where the value is one that fits."""
    if given in (_WHOLE, _REAL, _TRUTH, _NOTHING):
        return "a list"
    kinds = {_kind(one, view) for one in value.named_children} if value.type == "list" else set()
    if kind in _FLOATS and kinds & {_WHOLE, _TEXT}:
        return "floats alone: `1.0` for `1`"
    return "whole numbers alone" if "int" in kind and kind != "uint8" and kinds & {_REAL, _TEXT} else ""


def _as_float(value: Node, view: FileView) -> str:
    text = view.text(value)
    return f"`{text}.0`" if value.type in ("integer", "unary_operator") and text.lstrip("+-").isdigit() else "a float"


def _given(given: str, value: Node, view: FileView) -> str:
    what = given or ("a list of other numbers" if value.type == "list" else "another value")
    return f"{what}, `{view.short(value, 40)}`" if not arguments(value) or len(view.text(value)) < 40 else what


def _shown(kind: str) -> str:
    return f"`{kind}`"


RULE = FileRule(
    id="node.message_value_python",
    title="Field set to a value of another kind (rclpy)",
    finds="A field of a message of builtin_interfaces, std_msgs, geometry_msgs, sensor_msgs, nav_msgs, diagnostic_msgs "
    "or tf2_msgs, or of a request or response of std_srvs, that is set to a literal, or to the result of `int()`, "
    "`float()`, `str()`, `bool()` or `len()`, of another kind: a whole number for a float (`linear.x = 1`), a number "
    "for a text or a bool, a time of rclpy without `to_msg()` for a stamp.",
    why="Up to Iron this raises AssertionError, and the node ends with the first message. From Jazzy on nobody "
    "checks: the whole number 1 is sent as 5e-324, the number 1 as False, and what cannot be sent at all raises when "
    "it is published.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("messages",),
    bad="""import rclpy
from geometry_msgs.msg import Twist
def drive(publisher):
    command = Twist()
    command.linear.x = 1
    publisher.publish(command)
""",
    good="""import rclpy
from geometry_msgs.msg import Twist
def drive(publisher):
    command = Twist()
    command.linear.x = 1.0
    publisher.publish(command)
""",
    syntax="python",
    whole=True,
    gathers=("attribute",),
    words=("msg", "srv"),
    mentions=RCLPY,
    found=found,
)
