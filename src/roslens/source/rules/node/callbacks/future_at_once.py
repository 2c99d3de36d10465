"""Rule ``node.future_at_once``: the answer of a service, asked for before it can be there."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.calls import call_at, function_around, receiver, statement_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``.result()`` of a request, in the same expression or in the very next statement."""
    call, function = call_at(node), function_around(node)
    of = receiver(call) if call is not None else None
    if call is None or of is None:
        return
    asked = view.text(of)
    if not re.search(r"\.(call_async|send_goal_async|get_result_async)\(.*\)$", asked):
        statement = statement_around(call)
        before = statement.prev_named_sibling
        while before is not None and before.type == "comment":
            before = before.prev_named_sibling
        name = re.escape(asked)
        if function is None or before is None:
            return
        if not re.match(rf"^{name} = (?!await).*\.(call_async|send_goal_async)\(", view.text(before)):
            return
    if call.parent is not None and call.parent.type == "await":
        return
    yield view.hit(
        "node.future_at_once",
        call,
        f"`{view.text(call)[:80]}` right after the request is None: nothing has run that could have brought the "
        "answer; "
        "expected `await`, `add_done_callback`, or `spin_until_future_complete` before",
    )


RULE = FileRule(
    id="node.future_at_once",
    title="Answer of a service taken at once (rclpy)",
    finds="`client.call_async(request).result()`, or `result()` in the statement behind the request. Wait for it.",
    why="`result()` of a future that is not done is None and waits for nothing: the node goes on with no answer, and "
    "fails "
    "where it looks into it.",
    severity=Severity.ERROR,
    profiles=("ros2",),
    tags=("callbacks",),
    bad="import rclpy\nanswer = client.call_async(request).result()\n",
    good="import rclpy\nanswer = await client.call_async(request)\n",
    syntax="python",
    anchors=("result",),
    mentions=RCLPY,
    found=found,
)
