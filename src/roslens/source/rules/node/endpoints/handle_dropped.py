"""Rule ``node.handle_dropped``: a subscription, timer or service that ends where it was made."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, is_discarded, whole_name
from roslens.source.rules.cpp_flow.declared_with import made_with
from roslens.source.rules.cpp_flow.keeper import declared_keeper, keeper_of
from roslens.source.rules.cpp_flow.local_lambda import local_lambda
from roslens.source.rules.cpp_flow.variable_type import local_declaration
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_CALLBACK = re.compile(r"&\s*\w+(::\w+)+|\bbind\s*\(|^\[")
_LISTENER = "TransformListener"
_NODE = re.compile(r"\*?(?:this\b|\w*(?:node|nh)(?:_?handle)?_*$|n_*$|\w*n_?h_*$)", re.IGNORECASE)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call whose handle nobody keeps."""
    if view.text(node).endswith(_LISTENER):
        yield from _listener(node, view)
        return
    call = call_at(node)
    if call is None:
        return
    name, given = view.text(node), arguments(call)
    # No `subscribe` of ROS takes fewer than name, queue and callback; those of other libraries often do.
    if len(given) < (3 if name == "subscribe" else 2) or not any(_is_callback(one, call, view) for one in given[1:]):
        return
    if is_discarded(call):
        # Of a class of one's own, which gets the node as an argument and keeps what it makes, or is around the call.
        if _NODE.match(view.text(given[0])) or (
            name == view.text(call.child_by_field_name("function")) and _of_ros1(name)
        ):
            return
        yield view.hit(
            "node.handle_dropped",
            call,
            f"the handle that `{name}` returns is dropped: it ends at once and its callback never runs; expected a "
            "member that keeps it",
        )
        return
    keeper = keeper_of(call, view)
    if keeper is not None and keeper.ends_early(view):
        yield view.hit(
            "node.handle_dropped",
            call,
            f"`{keeper.name}` keeps what `{name}` returns only until this {keeper.scope_kind} ends, then its callback "
            "never runs; expected a member that keeps it",
        )


def _listener(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a listener to transforms that fills a buffer of the node for as long as a function or block lasts."""
    name, made = whole_name(node), above(node, "declaration", "call_expression", "compound_statement")
    keeper = None
    if made is not None and made.type == "declaration" and made.child_by_field_name("type") == name:
        keeper = declared_keeper(made, view)
        given = made_with(node)
    elif made is not None and made.type == "call_expression" and "make_" in view.text(made).partition("<")[0]:
        keeper, given = keeper_of(made, view), arguments(made)
    if keeper is None or not given or not _is_kept_buffer(given[0], view) or not keeper.ends_early(view):
        return
    yield view.hit(
        "node.handle_dropped",
        keeper.declaration,
        f"`{keeper.name}` listens to transforms only until this {keeper.scope_kind} ends, and `{view.text(given[0])}` "
        "gets none afterwards; expected a member that keeps it",
    )


def _is_kept_buffer(given: Node, view: FileView) -> bool:
    """Return whether a buffer lives on when a function has returned: it is none of its variables."""
    name = view.text(given).lstrip("*&").removeprefix("this->")
    function = above(given, "function_definition")
    if function is None or not name.isidentifier() or local_declaration(name, given, view) is not None:
        return False
    # ``Buffer buffer(get_clock());`` reads as the declaration of a function.
    before = view.code[function.start_byte : given.start_byte]
    return re.search(rf"\bBuffer\s+{name}\b".encode(), before) is None


def _of_ros1(name: str) -> bool:
    """Return whether a function is one of a node handle of ROS 1, which is called by an object."""
    return not name.startswith("create_")


def _is_callback(argument: Node, call: Node, view: FileView) -> bool:
    """Return whether an argument is a function, or a variable of the function around that holds a lambda."""
    text = view.text(argument)
    if _CALLBACK.search(text):
        return True
    name = re.fullmatch(r"(?:std::move\()?(\w+)\)?", text)
    return name is not None and local_lambda(name[1], call, view) is not None


RULE = FileRule(
    id="node.handle_dropped",
    title="Handle of a subscription, timer or service not kept",
    finds="A call that makes a subscription, a timer or a service and whose result is dropped, or kept only by a local "
    "variable of a function that returns, or of a block that ends before the node spins; and "
    "likewise a listener that fills a transform buffer which is a member. Keep it in a member.",
    why="The handle is the endpoint: when the last copy is gone, the subscription is closed and the timer stopped. The "
    "node starts without an error and never reacts.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("endpoints",),
    bad="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") { create_wall_timer(100ms, [this] { tick(); }); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") { timer_ = create_wall_timer(100ms, [this] { tick(); }); }
""",
    syntax="cpp",
    anchors=(
        *("create_subscription", "create_generic_subscription", "create_wall_timer", "create_timer", "create_service"),
        _LISTENER,
        *("subscribe", "advertiseService", "createTimer", "createWallTimer", "createSteadyTimer"),
    ),
    mentions=ROS_CPP,
    found=found,
)
