"""Rule ``cpp.assert_text``: an assertion of a text, which is always true."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ASSERTIONS = (
    "ROS_ASSERT",
    "ROS_ASSERT_MSG",
    "ROS_ASSERT_CMD",
    "assert",
    "BOOST_ASSERT",
    "BOOST_ASSERT_MSG",
    "assert_true",
    "GZ_ASSERT",
    "IGN_ASSERT",
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an assertion whose condition is a literal text."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if (
        call is None
        or not given
        or given[0].type not in ("string_literal", "concatenated_string", "raw_string_literal")
    ):
        return
    text = view.short(given[0])
    expected = f"a condition with the text: `!{text}` always fails, `condition && {text}` where it is not met"
    yield view.hit(
        "cpp.assert_text",
        call,
        f"`{view.short(call)}` never fails: a text is true; expected {expected}",
    )


RULE = FileRule(
    id="cpp.assert_text",
    title="Assertion of a text",
    finds='`ROS_ASSERT("…")`, `assert("…")` and the like, whose condition is a text alone. Assert a condition, or '
    "`false && …` where the line must not be reached.",
    why="A text is a pointer that is not null: the assertion holds whatever happens, and the node goes on with what it "
    "should have refused.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=(),
    bad='void f(int wheel) { if (wheel > 2) { ROS_ASSERT("no such wheel"); } }\n',
    good='void f(int wheel) { ROS_ASSERT_MSG(wheel <= 2, "no such wheel"); }\n',
    syntax="cpp",
    anchors=_ASSERTIONS,
    found=found,
)
