"""Rule ``node.late_loop_variable_python``: callbacks made in a loop that all see the last value of its variable."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.flow.python_callbacks import python_callbacks
from roslens.source.rules.flow.python_parameters import parameters_of
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_FUNCTIONS = ("function_definition", "lambda", "class_definition", "module")
_COMPREHENSIONS = ("list_comprehension", "dictionary_comprehension", "set_comprehension", "generator_expression")


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each function that is made and registered in a loop, and reads a variable that the loop sets."""
    callbacks = python_callbacks(view)
    said: set[int] = set()
    for one in callbacks.registrations if callbacks is not None else ():
        function = one.target.function
        loop = _loop_around(function)
        is_inside = loop is not None and loop.start_byte <= one.call.start_byte < loop.end_byte
        if loop is None or not is_inside or function.id in said:
            continue
        said.add(function.id)
        own = {each.name for each in parameters_of(function, view)} | _set_in(function, view)
        changing = _set_by(loop, view) - own
        name = next((text for text in map(view.text, _reads(function)) if text in changing), "")
        if name and not _leaves_at_once(loop):
            yield view.hit(
                "node.late_loop_variable_python",
                function,
                f"`{name}` is read when the callback runs: all that this loop registers see its last value; expected "
                f"`{name}={name}` among the parameters, or `partial`",
            )


def _loop_around(function: Node) -> Node | None:
    found = function.parent
    while found is not None and found.type not in _FUNCTIONS:
        if found.type == "for_statement" or found.type in _COMPREHENSIONS:
            return found
        found = found.parent
    return None


def _set_by(loop: Node, view: FileView) -> set[str]:
    """Return the names that a loop sets anew each time."""
    if loop.type == "for_statement":
        lefts = [loop.child_by_field_name("left")]
        body = loop.child_by_field_name("body")
        inner = below(body, "assignment", inside=_FUNCTIONS) if body is not None else ()
        lefts += [one.child_by_field_name("left") for one in inner]
    else:
        lefts = [one.child_by_field_name("left") for one in loop.named_children if one.type == "for_in_clause"]
    return {name for left in lefts for name in _names(left, view)}


def _set_in(function: Node, view: FileView) -> set[str]:
    """Return the names that a function sets itself."""
    lefts = (
        one.child_by_field_name("left") or one.child_by_field_name("name")
        for one in below(function, "assignment", "for_statement", "for_in_clause", "named_expression")
    )
    return {name for left in lefts for name in _names(left, view)}


def _names(left: Node | None, view: FileView) -> Iterator[str]:
    """Yield the names that the target of an assignment binds."""
    if left is not None and left.type == "identifier":
        yield view.text(left)
    elif left is not None and left.type in ("pattern_list", "tuple_pattern"):
        for one in left.named_children:
            yield from _names(one, view)


def _reads(function: Node) -> Iterator[Node]:
    body = function.child_by_field_name("body")
    if body is not None and body.type == "identifier":
        yield body
    for one in below(body, "identifier") if body is not None else ():
        around = one.parent
        if around is None:
            continue
        is_attribute = around.type == "attribute" and around.child_by_field_name("attribute") == one
        is_keyword = around.type == "keyword_argument" and around.child_by_field_name("name") == one
        if not is_attribute and not is_keyword:
            yield one


def _leaves_at_once(loop: Node) -> bool:
    """Tell whether the body of a loop ends with leaving it: it registers one callback."""
    body = loop.child_by_field_name("body") if loop.type == "for_statement" else None
    last = body.named_children[-1].type if body is not None and body.named_children else ""
    return last in ("break_statement", "return_statement")


RULE = FileRule(
    id="node.late_loop_variable_python",
    title="Callback made in a loop that sees its last value (Python)",
    finds="A lambda or function that a loop makes and registers as a callback, and that reads a variable of the loop. "
    "Give the value as a default, `lambda message, topic=topic: …`, or use `functools.partial`.",
    why="Python reads the variable when the callback runs, long after the loop: messages of all topics are taken for "
    "those of the last one.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("callbacks",),
    clauses=("ruff B023", "pylint W0640"),
    bad="""import rclpy
class Ears(Node):
    def __init__(self):
        for topic in ("left", "right"):
            self.create_subscription(String, topic, lambda message: self.hear(topic, message), 10)
""",
    good="""import rclpy
class Ears(Node):
    def __init__(self):
        for topic in ("left", "right"):
            self.create_subscription(String, topic, lambda message, topic=topic: self.hear(topic, message), 10)
""",
    syntax="python",
    whole=True,
    words=("for",),
    mentions=ROS_PYTHON,
    found=found,
)
