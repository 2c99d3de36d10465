"""Rule ``node.response_unset``: a service answers without having looked at its response."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import arguments, body_of, call_at, template_argument
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.file_view import FileView, above, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_ANSWERS = frozenset(
    (
        *("SetBool", "Trigger", "AddTwoInts", "GetMap", "GetPlan", "SetMap", "LoadMap", "GetParameters"),
        *("SetParameters", "ListParameters", "DescribeParameters", "SetParametersAtomically", "GetPositionIK"),
        *("GetPlanningScene", "GetState", "ChangeState", "FrameGraph", "SetCameraInfo", "SpawnEntity", "DeleteEntity"),
    )
)
"""Types of services of which each answer says something; the response of others may be empty."""
_FEWEST = 2


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a function that is registered for a service and never names its response."""
    call = call_at(node)
    if call is None:
        return
    for function in _handlers(call, view):
        response = _response(function, view)
        body = body_of(function)
        if response is None or body is None or _is_hopeless(body):
            continue
        kind = _kind(call, response, view)
        name = view.text(name_node(response.child_by_field_name("declarator"))).lstrip("&* ")
        if kind not in _ANSWERS or _is_used(name, body, view):
            continue
        yield view.hit(
            "node.response_unset",
            response,
            f"the response of service type {kind} is never set: the client gets "
            f"{'`success: false`' if kind in ('SetBool', 'Trigger') else 'its defaults'} whatever was done; expected "
            "its fields to be assigned",
        )


def _handlers(call: Node, view: FileView) -> Iterator[Node]:
    """Yield the functions of the file that a call registers."""
    for one in arguments(call)[1:]:
        if one.type == "lambda_expression":
            yield one
            return
        named = [one] if one.type == "pointer_expression" else list(below(one, "pointer_expression"))
        for each in named:
            name = "::".join(view.text(each.child_by_field_name("argument")).split("::")[-2:])
            yield from _definitions(name, view)


def _definitions(name: str, view: FileView) -> Iterator[Node]:
    last = name.rpartition("::")[2]
    for at in word_places(last.encode(), view) if last.isidentifier() else ():
        word = view.node_at(at, at + len(last))
        declarator = above(word, "function_declarator", "compound_statement") if word is not None else None
        function = declarator.parent if declarator is not None else None
        if function is None or function.type != "function_definition" or declarator is None:
            continue
        if name_node(declarator) is not None and function_name(function, view) == name:
            yield function
            return


def _response(function: Node, view: FileView) -> Node | None:
    """Return the parameter of a handler that is the response."""
    declarator = function.child_by_field_name("declarator")
    if declarator is None:
        return None
    listed = declarator.child_by_field_name("parameters")
    given = [one for one in listed.named_children if one.type == "parameter_declaration"] if listed is not None else []
    if len(given) < _FEWEST:
        return None
    return given[-1] if "Response" in view.text(given[-1]) else None


def _kind(call: Node, response: Node, view: FileView) -> str:
    """Return the last part of the type of a service."""
    by_template = template_argument(call, view).rpartition("::")[2]
    if by_template.isidentifier():
        return by_template
    written = re.search(r"(\w+)(?:::Response|Response)\b", view.text(response))
    return written[1] if written is not None else ""


def _is_used(name: str, body: Node, view: FileView) -> bool:
    if not name.isidentifier():
        return False
    for at in word_places(name.encode(), view, body.start_byte, body.end_byte):
        word = view.node_at(at, at + len(name))
        around = word.parent if word is not None else None
        is_dropped = around is not None and around.type == "cast_expression" and view.text(around).startswith("(void)")
        if not is_dropped:
            return True
    return False


def _is_hopeless(body: Node) -> bool:
    """Return whether a handler does nothing but throw or is a stub of a test."""
    return body.named_child_count == 0 or any(one.type == "throw_statement" for one in body.named_children)


RULE = FileRule(
    id="node.response_unset",
    title="Service that leaves its response untouched",
    finds="A function that a file registers for a service of a well-known type whose response holds fields, such as "
    "SetBool and Trigger, and that never names its response, or has no name for it.",
    why="The client sees the default values, `success: false` in most cases, and takes the call for failed: it tries "
    "again, or stops.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "services"),
    bad="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") { s_ = create_service<std_srvs::srv::Trigger>("home", std::bind(&Arm::home, this, _1, _2)); }
void Arm::home(const Request::SharedPtr, Trigger::Response::SharedPtr response) { go_home(); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") { s_ = create_service<std_srvs::srv::Trigger>("home", std::bind(&Arm::home, this, _1, _2)); }
void Arm::home(const Request::SharedPtr, Trigger::Response::SharedPtr response) { response->success = go_home(); }
""",
    syntax="cpp",
    anchors=("create_service", "advertiseService"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
