"""Rule ``node.sent_type_python``: something else is published, or sent as a request, than the type that was named."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import arguments, is_handled, keywords, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_messages import PythonMessages, python_messages
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_MAKES = {
    "publish": ("create_publisher", "create_lifecycle_publisher"),
    "call_async": ("create_client",),
    "call": ("create_client",),
}
_LITERALS = ("string", "concatenated_string", "integer", "float", "list", "dictionary", "none", "true", "false")
_TYPES = ("msg_type", "srv_type")


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each message and request that is sent and is of another type."""
    messages = python_messages(view)
    if not messages.imported or b"rospy" in view.words:
        return
    for call in python_functions(view).calls:
        method, given = callee_name(call, view), arguments(call)
        if method in _MAKES and len(given) == 1 and not is_handled(call):
            kind = _kind(receiver(call), _MAKES[method], messages, view)
            problem = _problem(given[0], kind, messages, view, is_request=method != "publish") if kind else ""
            if problem:
                yield view.hit("node.sent_type_python", given[0], problem)


def _kind(sender: Node | None, makes: tuple[str, ...], messages: PythonMessages, view: FileView) -> str:
    """Return the type of a publisher or client; empty where not all that it may be has one."""
    kinds = set()
    for value in python_functions(view).values(sender) if sender is not None else ():
        if value.type == "none":
            continue
        if value.type != "call" or callee_name(value, view) not in makes:
            return ""
        placed, named = arguments(value), keywords(value, view)
        kinds.add(
            messages.type_named(placed[0] if placed else next((named[one] for one in _TYPES if one in named), None))
        )
    return kinds.pop() if len(kinds) == 1 else ""


def _problem(one: Node, kind: str, messages: PythonMessages, view: FileView, *, is_request: bool) -> str:
    """Return what is wrong with what is sent; empty where nothing is."""
    name = kind.rpartition("/")[2]
    wanted = f"{name}.Request()" if is_request else f"{name}()"
    what = "client asks with" if is_request else "publisher sends"
    if one.type in _LITERALS and not view.text(one).lower().startswith(("b'", 'b"', "rb")):
        return f"this {what} `{wanted}`, and `{view.short(one, 40)}` is given: a TypeError; expected such an object"
    if messages.type_named(one) == kind:
        return f"this gives the class `{view.text(one)}` itself: a TypeError; expected an object of it, `{wanted}`"
    made = _made(one, messages, view)
    if made and made != (f"{kind}.Request" if is_request else kind):
        return f"this {what} `{wanted}`, and an object of `{made}` is given: a TypeError; expected one of its type"
    return ""


def _made(one: Node, messages: PythonMessages, view: FileView) -> str:
    """Return the type of a message that is made right here; of a variable where its fields are known."""
    if one.type != "call":
        known = messages.type_of(one)
        return f"{known.removesuffix('_Request')}.Request" if known.endswith("_Request") else known
    callee = one.child_by_field_name("function")
    kind = messages.type_named(callee)
    service, _, part = view.text(callee).rpartition(".")
    return kind or (f"{messages.imported[service]}.{part}" if service in messages.imported else "")


RULE = FileRule(
    id="node.sent_type_python",
    title="Something else sent than the type that was named (rclpy)",
    finds="`publish` of a publisher, and `call` or `call_async` of a client, that is given a text, a number or another "
    "literal, the class of the message instead of an object, or a message or request of another type than the one with "
    "which the publisher or client was made.",
    why="rclpy checks the type and raises TypeError: the node ends with the first message that it sends.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("messages", "endpoints"),
    bad="""import rclpy
from std_msgs.msg import String
class Arm(Node):
    def __init__(self):
        self.out = self.create_publisher(String, 'state', 10)
    def on_tick(self):
        self.out.publish('ready')
""",
    good="""import rclpy
from std_msgs.msg import String
class Arm(Node):
    def __init__(self):
        self.out = self.create_publisher(String, 'state', 10)
    def on_tick(self):
        self.out.publish(String(data='ready'))
""",
    syntax="python",
    whole=True,
    words=("msg", "srv"),
    mentions=RCLPY,
    found=found,
)
