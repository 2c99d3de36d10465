"""Rule ``cpp.swallowed``: a handler of everything that does nothing."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import function_declarator, has_token, name_node
from roslens.source.rules.cpp_statement import next_statement
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each handler of anything whose body is empty, without a comment too."""
    parameters, body = node.child_by_field_name("parameters"), node.child_by_field_name("body")
    # A comment in the body is a node, too: a reason.
    if parameters is None or body is None or body.named_child_count or not has_token(parameters, "..."):
        return
    line = view.lines[view.place(body.end_byte - 1)[0] - 1]
    around = above(node, "function_definition")
    is_last_act = around is not None and "~" in view.text(name_node(function_declarator(around)))
    # Whether it went well is asked right behind it.
    whole = next_statement(node.parent) if node.parent is not None else None
    if whole is not None and whole.type == "if_statement":
        return
    tried = node.parent.child_by_field_name("body") if node.parent is not None else None
    if tried is not None and _is_one_value(tried):
        certainty: Certainty | None = Certainty.HEURISTIC
    else:
        certainty = None
    if not is_last_act and b"//" not in line and b"/*" not in line:
        yield view.hit(
            "cpp.swallowed",
            node,
            "`catch (...)` swallows every exception; expected a log, a reason or a narrower type",
            certainty=certainty,
        )


def _is_one_value(body: Node) -> bool:
    """Return whether all that is tried is to give one variable its value, which may be missing, and to log it."""
    inner = [one.named_children[0] if one.named_child_count == 1 else one for one in body.named_children]
    values = [one for one in inner if one.type == "assignment_expression"]
    others = [one for one in inner if one.type not in ("assignment_expression", "comment")]
    return len(values) == 1 and all(_is_log(one) for one in others)


def _is_log(node: Node) -> bool:
    function = node.child_by_field_name("function") if node.type == "call_expression" else None
    return function is not None and function.text is not None and function.text.startswith((b"ROS_", b"RCLCPP_"))


RULE = FileRule(
    id="cpp.swallowed",
    title="Every exception swallowed",
    finds="`catch (...)` with an empty body and no comment that says why. Log it, handle it or let it pass.",
    why="A driver that failed to start goes on as if nothing had happened; even a thread that is being "
    "cancelled is held up.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    clauses=("clang-tidy bugprone-empty-catch",),
    bad="void f() { try { g(); } catch (...) {} }\n",
    good='void f() { try { g(); } catch (...) { log("g failed"); } }\n',
    syntax="cpp",
    kinds=("catch_clause",),
    spares_tests=True,
    found=found,
)
