"""Rule ``node.service_result_dropped``: a call of a service that may have failed."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.calls import arguments, call_at, function_around, is_discarded, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FIRMWARE, ROSCPP, FileRule

_CLIENT = re.compile(r"client|srv|service", re.IGNORECASE)

_ACTS = re.compile(
    rb"(?<![\w:.>])(?!if\b|while\b|for\b|switch\b|return\b|exit\b|sleep\b|usleep\b|delete\b)[a-z]\w*\s*\(|\.publish\s*\("
)
"""What happens after the call and may rest on it: calls of own functions, and messages."""
_LOOKED_AT = re.compile(rb"\b(?:res|response|resp)\.(?:success|ok|result)\b")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``client.call(request)`` as a statement of its own."""
    call, function = call_at(node), function_around(node)
    if any(one in view.content for one in FIRMWARE):
        return
    if call is None or not is_discarded(call) or len(arguments(call)) not in (1, 2):
        return
    text = view.text(call.child_by_field_name("function"))
    of = receiver(call)
    name = view.text(of)
    is_client = text == "ros::service::call" or (
        of is not None
        and (
            re.search(rb"ServiceClient\s+" + re.escape(name.encode()) + rb"\b", view.code) is not None
            or (_CLIENT.search(name) is not None and name.isidentifier())
        )
    )
    after = view.code[call.end_byte : function.end_byte] if function is not None else b""
    if is_client and not _LOOKED_AT.search(after):
        given = view.text(arguments(call)[-1])
        used = re.search(rb"\b" + re.escape(given.encode()) + rb"(?:\.|->)res", after) is not None
        goes_on = re.search(_ACTS, after) is not None
        yield view.hit(
            "node.service_result_dropped",
            call,
            f"result of `{view.text(call)}` is dropped: where the service is not there, the response is empty; "
            "expected "
            "`if (!...)`",
            severity=None if used or goes_on else Severity.NOTE,
        )


RULE = FileRule(
    id="node.service_result_dropped",
    title="Result of a service call dropped",
    finds="`client.call(...)` of roscpp as a statement of its own. Ask whether it is true. "
    "It is a note where the function does nothing behind the call.",
    why="It returns false where the service is gone or refuses, and the response then holds its defaults: brakes that "
    "were "
    "asked to close are taken for closed.",
    profiles=("ros1",),
    tags=("endpoints",),
    bad="#include <ros/ros.h>\nvoid f() { ros::ServiceClient brake; brake.call(close); drive(); }\n",
    good="#include <ros/ros.h>\nvoid f() { ros::ServiceClient brake; if (brake.call(close)) drive(); }\n",
    syntax="cpp",
    anchors=("call",),
    mentions=ROSCPP,
    spares_tests=True,
    found=found,
)
