"""Rule ``node.service_result_dropped``: a call of a service that may have failed."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, function_around, is_discarded, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FIRMWARE, ROSCPP, FileRule

_CLIENT = re.compile(r"client|srv|service", re.IGNORECASE)

_ACTS = re.compile(
    rb"(?<![\w:.>])(?!if\b|while\b|for\b|switch\b|return\b|exit\b|sleep\b|usleep\b|delete\b)[a-z]\w*\s*\(|\.publish\s*\("
)
"""What happens after the call and may rest on it: calls of own functions, and messages."""
_DOES = re.compile(rb"^\s*[a-z]\w*\s*\(|\.publish\s*\(|\bcall\s*\(", re.MULTILINE)
"""What is done between two calls of a service, but for what the second one is given."""
_BLOCKS = ("compound_statement", "case_statement")
_LEAVES = ("return_statement", "throw_statement")
_SERVED = re.compile(rb"(\w+)\s*(?:\.|->)\s*advertiseService\s*(?:<[^;()]*>)?\s*\(\s*\"([^\"\n]*)\"")
_MADE = rb"\s*[=(]\s*(\w+)\s*(?:\.|->)\s*serviceClient\s*(?:<[^;()]*>)?\s*\(\s*\"([^\"\n]*)\""
"""How a service and a client of it are made: the handle, and the name where it is a text."""
_WAITED = re.compile(rb"\bwaitFor(?:Service|Existence)\s*\(")
_LOOKED_AT = re.compile(
    rb"\b(?:res|response|resp)\.(?:success|ok|result)\b"
    rb"|\bif\s*\(\s*!\s*[\w.>-]*\b(?:res|response|resp)\.\w+\s*\)"
)
"""That the response says so, or that a truth in it is missing, as it is where nobody answered."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``client.call(request)`` as a statement of its own."""
    call, function = call_at(node), function_around(node)
    if view.mentions(FIRMWARE):
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
    after = _behind(call, function, view.code) if function is not None else b""
    if is_client and not _is_served_here(name, view) and not _LOOKED_AT.search(after):
        yield view.hit(
            "node.service_result_dropped",
            call,
            f"result of `{view.text(call)}` is dropped: where the service is not there, the response is empty; "
            "expected "
            "`if (!...)`",
            certainty=None if _matters(call, function, after, view) else Certainty.HEURISTIC,
        )


def _is_served_here(client: str, view: FileView) -> bool:
    """Return whether the file itself advertises the service, by the same handle or by its whole name."""
    served = {(one[1], one[2]) for one in _SERVED.finditer(view.content) if _is_code(one, 2, view)}
    made = re.compile(rb"\b" + re.escape(client.encode()) + _MADE) if client else None
    asked = [(one[1], one[2]) for one in made.finditer(view.content) if _is_code(one, 2, view)] if made else []
    names = {name for _, name in served}
    return bool(asked) and all(one in served or (one[1].startswith(b"/") and one[1] in names) for one in asked)


def _is_code(match: re.Match[bytes], group: int, view: FileView) -> bool:
    """Return whether a match up to a text stands in code: comments are blank there."""
    return view.code[match.start() : match.start(group) - 1] == match[0][: match.start(group) - 1 - match.start()]


def _behind(call: Node, function: Node, text: bytes) -> bytes:
    """Return what runs behind a call, of the code or the content; other branches of an ``if`` around it are blank."""
    end = _end_of_way(call, function)
    found = bytearray(text[call.end_byte : end])
    inner = call
    while inner.parent is not None and inner != function:
        around = inner.parent
        other = around.child_by_field_name("alternative") if around.type == "if_statement" else None
        if other is not None and other != inner and other.start_byte < end:
            start, stop = other.start_byte - call.end_byte, min(other.end_byte, end) - call.end_byte
            found[start:stop] = b" " * (stop - start)
        inner = around
    return bytes(found)


def _end_of_way(call: Node, function: Node) -> int:
    """Return where what runs behind a call ends: at a jump out of the function in a block around it, or with it."""
    inner = call
    while inner.parent is not None and inner != function:
        following = inner.next_named_sibling
        while inner.parent.type in _BLOCKS and following is not None:
            if following.type in _LEAVES:
                return following.end_byte
            following = following.next_named_sibling
        inner = inner.parent
    return function.end_byte


def _matters(call: Node, function: Node | None, after: bytes, view: FileView) -> bool:
    """Return whether what follows a call rests on it: the response is read, or other things are done."""
    given = view.text(arguments(call)[-1])
    asked = _asked_again(call, function, after, view)
    read = after if asked is None else asked
    if re.search(rb"\b" + re.escape(given.encode()) + rb"(?:\.|->)res", read):
        return True
    if asked is not None and re.search(_DOES, asked) is None:
        return False
    before = view.code[function.start_byte : call.start_byte] if function is not None else b""
    return re.search(_ACTS, after) is not None and not _WAITED.search(before)


def _asked_again(call: Node, function: Node | None, after: bytes, view: FileView) -> bytes | None:
    """Return what stands before the next call of the same service whose result is looked at; None is no such call."""
    text = view.text(call)
    service = text.rpartition("," if text.startswith("ros::service::call") else "(")[0]
    behind = _behind(call, function, view.content) if function is not None else b""
    again = re.search(rb"[(!=&|]\s*" + re.escape(service.encode()) + rb"\s*[,(]", behind)
    return None if again is None else after[: again.start()]


RULE = FileRule(
    id="node.service_result_dropped",
    title="Result of a service call dropped",
    finds="`client.call(...)` of roscpp as a statement of its own. Ask whether it is true. "
    "It is a note where the function does nothing behind the call, or waited for the service before and looks at no "
    "response. A service that the same file advertises is there.",
    why="It returns false where the service is gone or refuses, and the response then holds its defaults: brakes that "
    "were "
    "asked to close are taken for closed.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
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
