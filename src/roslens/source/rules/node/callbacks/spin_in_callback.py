"""Rule ``node.spin_in_callback``: a callback that spins the executor it runs in."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, loop_around
from roslens.source.rules.cpp_flow.callback_chain import Chain, chain_to
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_ITSELF = re.compile(r"^\*?(?:this->)?(?:shared_from_this|get_node_base_interface)\(\)|^this\b")
_FIRST_NAME = re.compile(r"^\*?(?:this->)?(\w+)(?:->get_node_base_interface\(\))?$")

_ADDS = "add_node"
_OWN_SUBSCRIBER = re.compile(rb"\bSubscriber\s+\w+\s*=\s*[^;]*\bsubscribe\b")

_OF_A_SERVICE = re.compile(rb"Request\s*&")
"""The server of a service in ROS 1 can wait for what it is asked for in no other way, and that works."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that spins in a callback; an executor of its own may spin another node."""
    call = call_at(node)
    if call is None:
        return
    text = view.text(call.child_by_field_name("function")).partition("<")[0]
    is_ros2 = text.startswith("rclcpp::") or view.text(node) == _ADDS
    if not is_ros2 and text not in ("ros::spin", "ros::spinOnce"):
        return
    if is_ros2 and not _is_own_node(call, view):
        return
    chain = chain_to(call, view) if is_ros2 else _direct(call, view)
    if chain is not None and (is_ros2 or not _is_waited_for(call, view)):
        expected = "`async_send_request` with a callback" if is_ros2 else "the callback to return"
        yield view.hit(
            "node.spin_in_callback",
            call,
            f"`{text}` in {spoken(chain.callback)}{chain.through}, {_problem(node, view)}; expected {expected}",
            callback=chain.callback,
            certainty=None if is_ros2 else _certainty(call, text),
        )


def _problem(node: Node, view: FileView) -> str:
    if view.text(node) == _ADDS:
        return "whose node is in an executor already, so that it throws"
    return "which an executor is running already"


def _direct(call: Node, view: FileView) -> Chain | None:
    callback = callback_around(call, view)
    return Chain(callback) if callback is not None else None


def _certainty(call: Node, text: str) -> Certainty:
    """Return how certain it is in ROS 1.

    What a callback takes in before it begins cannot change under it, nor what it takes in when it has ended: roscpp
    allows to spin in callbacks.
    """
    function, statement = function_around(call), call.parent
    body = body_of(function) if function is not None else None
    steps = [one for one in body.named_children if one.type != "comment"] if body is not None else []
    if steps and steps[-1].type == "return_statement" and not steps[-1].named_children:
        steps.pop()
    at_an_end = statement is not None and statement in (*steps[:1], *steps[-1:])
    return Certainty.HEURISTIC if text == "ros::spinOnce" and at_an_end else Certainty.LIKELY


def _is_waited_for(call: Node, view: FileView) -> bool:
    """Return whether a loop of ROS 1 takes in what its own subscriber receives, or what a service is to answer."""
    function, loop = function_around(call), loop_around(call)
    if function is None or loop is None:
        return False
    before = view.code[function.start_byte : loop.start_byte]
    head = before.partition(b"{")[0]
    return _OF_A_SERVICE.search(head) is not None or _OWN_SUBSCRIBER.search(before) is not None


def _is_own_node(call: Node, view: FileView) -> bool:
    """Return whether a call spins a node that has callbacks in this file; a second one, for requests, may be spun."""
    given = arguments(call)
    if not given:
        return False
    text = view.text(given[0])
    if _ITSELF.search(text):
        return True
    name = _FIRST_NAME.match(text)
    if name is None or not (word := name[1]).isidentifier():
        return False
    registers = (
        rb"\b"
        + re.escape(word.encode())
        + rb"\s*->\s*(?:create_subscription|create_service|create_wall_timer|create_timer)\b"
    )
    handed = rb"create_server\s*<[^;()]*>\s*\(\s*" + re.escape(word.encode()) + rb"\b"
    return re.search(registers + rb"|" + handed, view.code) is not None


RULE = FileRule(
    id="node.spin_in_callback",
    title="Spinning in a callback",
    finds="`rclcpp::spin_until_future_complete`, `rclcpp::spin_some`, `rclcpp::spin`, `ros::spinOnce` or `ros::spin` "
    "in a callback, or in a function of the file that it calls; in ROS 2 also a node that adds itself to an executor "
    "there. Give the request a callback of its own instead, or return. In ROS 1 a callback that begins or "
    "ends with `ros::spinOnce` is a note: nothing of it can change under it.",
    why="In ROS 2 the node already belongs to the executor that runs the callback, and adding it to another throws "
    "«Node has already been added to an executor»: the process ends. In ROS 1 callbacks run inside each other, in an "
    "order nobody meant.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "deadlock"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { rclcpp::spin_until_future_complete(shared_from_this(), client_->async_send_request(r_)); }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { client_->async_send_request(r_, [this](Client::SharedFuture f) { take(f.get()); }); }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
""",
    syntax="cpp",
    anchors=(_ADDS, "spin_until_future_complete", "spin_some", "spin", "spinOnce"),
    mentions=ROS_CPP,
    found=found,
)
