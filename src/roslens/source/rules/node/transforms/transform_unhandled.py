"""Rule ``node.transform_unhandled``: a look-up of a transform that nobody catches."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import spoken
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, receiver
from roslens.source.rules.cpp_flow.callback_chain import Chain, chain_to
from roslens.source.rules.cpp_flow.handlers import catches, caught_type, handlers_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_ASKS_FIRST = re.compile(rb"canTransform|waitForTransform")
_TRIES = re.compile(rb"\btry\b")
_THROWN = frozenset(
    (
        *("TransformException", "LookupException", "ConnectivityException", "ExtrapolationException"),
        *("InvalidArgumentException", "TimeoutException", "runtime_error"),
    )
)
"""Types of what a look-up throws, and of their bases."""
_ONE_OF_SEVERAL = frozenset(("LookupException", "ConnectivityException", "ExtrapolationException"))
"""Each for another reason why a transform is not known: at a start all three come, one after the other."""
_ASKED = rb"!\s*%(n)s\b|\b%(n)s(?:\.|->)(?:has_value|value|error|is_initialized)\b|if\s*\(\s*%(n)s\s*[)&|]"
_FEWEST = 3


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a look-up that no ``try`` is around which catches it, in a callback that neither asks nor waits before."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    if (
        call is None
        or body is None
        or receiver(call) is None
        or len(arguments(call)) < _FEWEST
        or _is_caught(call, view)
        or _is_asked(call, body, view)
        or _asks_before(call, view)
    ):
        return
    chain = chain_to(call, view, lambda one: not _is_caught(one, view) and not _asks_before(one, view))
    if chain is None:
        return
    handler = _other_handler(call, view)
    where = f"inside of `try` with a handler of {handler} alone" if handler else "outside of `try`"
    yield view.hit(
        "node.transform_unhandled",
        call,
        f"`{view.short(call, 80)}` {where}: it throws until the transform is known, which no callback survives"
        f"{_reached(chain)}; expected a handler of tf2::TransformException",
        callback=chain.callback,
    )


def _reached(chain: Chain) -> str:
    return f" ({spoken(chain.callback)} calls it{chain.through})" if chain.helpers else ""


def _is_caught(call: Node, view: FileView) -> bool:
    handlers = list(handlers_around(call))
    if not any(catches(_THROWN, one, view) for one in handlers):
        return False
    kinds = {caught_type(one, view).rpartition("::")[2] for one in handlers}
    return not (kinds <= _ONE_OF_SEVERAL and len(kinds) == 1)


def _other_handler(call: Node, view: FileView) -> str:
    """Return what a ``try`` around a look-up catches, which is not all that it throws; empty without any."""
    caught = [caught_type(one, view) for one in handlers_around(call)]
    return ", ".join(f"`{one}`" for one in caught)


def _asks_before(call: Node, view: FileView) -> bool:
    """Return whether a function asks or waits before a call, or tries something, outside of the ``try`` around it."""
    function = function_around(call)
    body = body_of(function) if function is not None else None
    if body is None:
        return False
    end, around = call.start_byte, call.parent
    while around is not None and around != body:
        tried = around.child_by_field_name("body") if around.type == "try_statement" else None
        if around is not None and tried is not None and tried.end_byte >= call.end_byte:
            end = around.start_byte
        around = around.parent
    before = view.code[body.start_byte : call.start_byte]
    return _ASKS_FIRST.search(before) is not None or _TRIES.search(before, 0, end - body.start_byte) is not None


def _is_asked(call: Node, body: Node, view: FileView) -> bool:
    """Tell whether it is asked of what the look-up returns if there is anything: such a look-up does not throw."""
    kept = call.parent
    name = kept.child_by_field_name("declarator") if kept is not None and kept.type == "init_declarator" else None
    if name is None:
        return False
    asked = _ASKED % {b"n": re.escape(view.text(name).encode())}
    return re.search(asked, view.code[call.end_byte : body.end_byte]) is not None


RULE = FileRule(
    id="node.transform_unhandled",
    title="Unhandled exception of a transform look-up",
    finds="`lookupTransform` outside of `try`, or in one that catches other exceptions or `LookupException` alone, in "
    "a callback or what it calls in the same file, where nothing asks `canTransform` or waits before. Catch "
    "`tf2::TransformException` and go on without.",
    why="At start, and whenever a localisation is late, the transform is not there, and the look-up throws: the node "
    "ends "
    "in the middle of a drive.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms", "exceptions"),
    bad="#include <rclcpp/rclcpp.hpp>\nvoid Arm::start() { t_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }\n"
    "void Arm::tick() { t_ = buffer_->lookupTransform(a, b, tf2::TimePointZero); }\n",
    good="#include <rclcpp/rclcpp.hpp>\nvoid Arm::start() "
    "{ t_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }\n"
    "void Arm::tick() {\n"
    "  try { t_ = buffer_->lookupTransform(a, b, tf2::TimePointZero); } catch (const tf2::TransformException & e) "
    "{ wait(e); }\n"
    "}\n",
    syntax="cpp",
    anchors=("lookupTransform",),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
