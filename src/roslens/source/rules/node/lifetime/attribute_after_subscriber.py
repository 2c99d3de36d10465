"""Rule ``node.attribute_after_subscriber``: a callback of rospy that may run before what it reads is there."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, is_conditional, keywords
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROSPY, FileRule

_FIRST_LOOK = re.compile(rb"hasattr|getattr")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a subscription in ``__init__`` whose method reads an attribute that ``__init__`` only sets afterwards."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or view.text(function.child_by_field_name("name")) != "__init__":
        return
    if view.text(call.child_by_field_name("function")) not in (f"rospy.{view.text(node)}", view.text(node)):
        return
    of_class, body = above(function, "class_definition"), body_of(function)
    if of_class is None or body is None or is_conditional(call, function):
        return
    named = keywords(call, view)
    for one in (*arguments(call)[1:], *(named[key] for key in ("callback", "handler") if key in named)):
        method = _method(view.text(one).removeprefix("self."), of_class, view) if one.type == "attribute" else None
        late = _late(method, call, body, of_class, view) if method is not None else None
        if late is not None:
            name, line = late
            yield view.hit(
                "node.attribute_after_subscriber",
                call,
                f"`{view.text(one)}` reads `self.{name}`, which `__init__` sets only in line {line}: a message that "
                "comes "
                "before fails; expected the subscription last",
                certainty=Certainty.HEURISTIC if _comes_later(call, line, view) else None,
            )


def _comes_later(call: Node, line: int, view: FileView) -> bool:
    """Return whether it is a timer, which first runs a period later, and nothing is done until a line is reached."""
    if callee_name(call, view) != "Timer":
        return False
    between = view.lines[view.place(call.end_byte)[0] : line - 1]
    return not any(b"(" in one.partition(b"#")[0] for one in between)


def _method(name: str, of_class: Node, view: FileView) -> Node | None:
    body = body_of(of_class)
    for one in body.named_children if body is not None else ():
        if one.type == "function_definition" and view.text(one.child_by_field_name("name")) == name:
            return one
    return None


def _late(method: Node, call: Node, body: Node, of_class: Node, view: FileView) -> tuple[str, int] | None:
    """Return the first attribute that a method reads and that is set after a call, with the line, if there is one."""
    code = view.code[method.start_byte : method.end_byte]
    head = view.code[of_class.start_byte : body.start_byte]
    if _FIRST_LOOK.search(code):
        return None
    before, after = view.code[body.start_byte : call.start_byte], (call.end_byte, body.end_byte)
    for match in re.finditer(rb"\bself\.(\w+)\b(?!\s*(\(|=(?!=)|:[^\n=]*=))", code):
        name = re.escape(match[1])
        setting = rb"\bself\." + name + rb"\s*(:[^\n=]*)?(,[^\n=]*)?=(?!=)"
        if re.search(setting, before) or re.search(rb"\b" + name + rb"\s*=", head):
            continue
        if re.search(setting, code[: match.start()]) or re.search(rb"def " + name + rb"\b", view.code):
            continue
        later = re.compile(setting).search(view.code, *after)
        if later is not None:
            return match[1].decode("utf-8", "replace"), view.place(later.start())[0]
    return None


RULE = FileRule(
    id="node.attribute_after_subscriber",
    title="Callback that may run before its attributes are set (rospy)",
    finds="A subscription, timer or service made in `__init__` before an attribute that its callback reads. Make it "
    "last.",
    why="rospy runs callbacks in threads of their own from the moment the subscriber is made: with a message already "
    "waiting, a latched one above all, the callback raises AttributeError, at some starts and not at others.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("lifetime", "concurrency"),
    bad="""import rospy
class Arm:
    def __init__(self):
        self.sub = rospy.Subscriber("goal", Goal, self.on_goal)
        self.count = 0
    def on_goal(self, goal):
        self.count += 1
        rospy.loginfo(self.count)
""",
    good="""import rospy
class Arm:
    def __init__(self):
        self.count = 0
        self.sub = rospy.Subscriber("goal", Goal, self.on_goal)
    def on_goal(self, goal):
        self.count += 1
        rospy.loginfo(self.count)
""",
    syntax="python",
    anchors=("Subscriber", "Timer", "Service"),
    mentions=ROSPY,
    found=found,
)
