"""Rule ``node.future_at_once``: the answer of a service, asked for before it can be there."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at, function_around, receiver, statement_around
from roslens.source.rules.file_view import FileView, all_above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``.result()`` of a request, in the same expression or in the very next statement."""
    call, function = call_at(node), function_around(node)
    of = receiver(call) if call is not None else None
    if call is None or of is None:
        return
    asked = view.text(of)
    if asked.startswith("(await") or _is_later(call):
        return
    if not re.search(r"\.(call_async|send_goal_async|get_result_async)\(.*\)$", asked) and not (
        function is not None and _is_asked_before(asked, call, view)
    ):
        return
    if call.parent is not None and call.parent.type == "await":
        return
    yield view.hit(
        "node.future_at_once",
        call,
        f"`{view.short(call, 80)}` right after the request is None: nothing has run that could have brought the "
        "answer; "
        "expected `await`, `add_done_callback`, or `spin_until_future_complete` before",
    )


def _is_asked_before(future: str, call: Node, view: FileView) -> bool:
    """Return whether the statement before makes the request of a future."""
    before = statement_around(call).prev_named_sibling
    while before is not None and before.type == "comment":
        before = before.prev_named_sibling
    request = rf"^{re.escape(future)} = (?!await).*\.(call_async|send_goal_async)\("
    return before is not None and re.match(request, view.text(before)) is not None


def _is_later(call: Node) -> bool:
    """Return whether a call runs later, in what is handed over, or again and again until there is an answer."""
    for one in all_above(call):
        if one.type in ("lambda", "while_statement"):
            return True
        if one.type in ("function_definition", "module"):
            return False
    return False


RULE = FileRule(
    id="node.future_at_once",
    title="Answer of a service taken at once (rclpy)",
    finds="`client.call_async(request).result()`, or `result()` in the statement behind the request. Wait for it.",
    why="`result()` of a future that is not done is None and waits for nothing: the node goes on with no answer, and "
    "fails "
    "where it looks into it.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("callbacks",),
    bad="import rclpy\nanswer = client.call_async(request).result()\n",
    good="import rclpy\nanswer = await client.call_async(request)\n",
    syntax="python",
    anchors=("result",),
    mentions=RCLPY,
    found=found,
)
