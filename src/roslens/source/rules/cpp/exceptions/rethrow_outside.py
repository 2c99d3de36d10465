"""Rule ``cpp.rethrow_outside``: an exception is thrown again where none is handled."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import call_at
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.file_view import FileView, above, all_above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_HANDLES = re.compile(r"handle|except|error|rethrow|translat|catch|fail", re.IGNORECASE)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``throw;`` outside of a handler, in a function that none calls."""
    if node.named_child_count or any(one.type in ("catch_clause", "ERROR") for one in all_above(node)):
        return
    function = above(node, "function_definition")
    name = function_name(function, view).rpartition("::")[2] if function is not None else ""
    if function is None or not name or _HANDLES.search(name) or b"current_exception" in view.code:
        return
    if _is_called_in_handler(name, view):
        return
    yield view.hit(
        "cpp.rethrow_outside",
        node,
        "`throw;` where no exception is handled: `std::terminate` ends the program, and no handler around the call "
        "sees anything; expected `throw std::runtime_error(…)`",
    )


def _is_called_in_handler(name: str, view: FileView) -> bool:
    for at in word_places(name.encode(), view):
        word = view.node_at(at, at + len(name))
        call = call_at(word) if word is not None else None
        if call is not None and above(call, "catch_clause") is not None:
            return True
    return False


RULE = FileRule(
    id="cpp.rethrow_outside",
    title="`throw;` without an exception",
    finds="`throw;` outside of a `catch`, in a function that no handler of the file calls. It throws again what is "
    "being handled, and here nothing is: name the exception.",
    why="It does not throw «something»: it ends the process at once, whatever handlers stand around the call.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1", "safety"),
    tags=("exceptions",),
    clauses=("cppcheck rethrowNoCurrentException",),
    bad="void f(bool known) { if (!known) { throw; } }\n",
    good='void f(bool known) { if (!known) { throw std::invalid_argument("unknown"); } }\n',
    syntax="cpp",
    kinds=("throw_statement",),
    found=found,
)
