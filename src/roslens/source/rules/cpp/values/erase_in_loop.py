"""Rule ``cpp.erase_in_loop``: an element is erased on which the loop goes on."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, is_discarded, loop_around, receiver
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.cpp_flow.leaving import leaves_behind
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an ``erase`` of the element at which the loop around it is, behind which the loop goes on."""
    call = call_at(node)
    given, loop = (arguments(call), loop_around(call)) if call is not None else ((), None)
    if call is None or receiver(call) is None or loop is None or len(given) != 1 or not is_discarded(call):
        return
    problem = ""
    if loop.type == "for_range_loop":
        problem = _of_range(call, given[0], loop, view)
    elif loop.type == "for_statement":
        problem = _of_iterator(given[0], loop, view)
    if problem and not leaves_behind(call, loop):
        yield _hit(call, view, problem)


def _of_range(call: Node, given: Node, loop: Node, view: FileView) -> str:
    """Return what is wrong with an erased element of the container that a loop goes over; empty where nothing is."""
    container = view.text(receiver(call))
    used = {view.text(one) for one in (given, *below(given, "identifier"))}
    if view.text(loop.child_by_field_name("right")) != container or not _declared(loop, view) & used:
        return ""
    return f"the loop over `{container}` goes on from the element that is gone"


def _of_iterator(given: Node, loop: Node, view: FileView) -> str:
    """Return what is wrong with an erased iterator of a loop; empty where nothing is."""
    name, update = view.text(given), view.text(loop.child_by_field_name("update"))
    if given.type != "identifier" or not re.search(rf"\+\+\s*{name}\b|\b{name}\s*\+\+", update):
        return ""
    if not _is_iterator(name, loop, view) or _is_set_again(name, loop, view):
        return ""
    return f"`{update}` goes on from an iterator that is gone"


def _hit(call: Node, view: FileView, problem: str) -> Hit:
    name = view.text(receiver(call))
    return view.hit(
        "cpp.erase_in_loop",
        call,
        f"behind `{view.short(call)}` {problem}; expected `it = {name}.erase(it)` in a loop that does not increment "
        "then, or `std::remove_if`",
    )


def _declared(loop: Node, view: FileView) -> set[str]:
    declarator = loop.child_by_field_name("declarator")
    if declarator is None:
        return set()
    return {view.text(one) for one in (declarator, *below(declarator, "identifier")) if one.type == "identifier"}


def _is_iterator(name: str, loop: Node, view: FileView) -> bool:
    initial = loop.child_by_field_name("initializer")
    if initial is None:
        return False
    for one in below(initial, "init_declarator"):
        if view.text(name_node(one)) == name:
            value = view.text(one.child_by_field_name("value"))
            return re.search(r"(?:\.|->)c?r?begin\(\)$|\bbegin\(", value) is not None
    return False


def _is_set_again(name: str, loop: Node, view: FileView) -> bool:
    """Return whether the iterator is set, or moved back, somewhere in the loop."""
    body = loop.child_by_field_name("body")
    if body is None:
        return True
    code = view.code[body.start_byte : body.end_byte]
    return re.search(rf"\b{name}\s*(?:=(?!=)|--|-=|\+=|\+\+)|(?:--|\+\+)\s*{name}\b".encode(), code) is not None


RULE = FileRule(
    id="cpp.erase_in_loop",
    title="Erased element in a loop that goes on",
    finds="`erase(it)` in a loop that increments `it` afterwards, or `erase` of the element at which a range-based "
    "loop over the same container is. Take the iterator that `erase` returns, or leave the loop.",
    why="The iterator is no longer valid: the loop reads memory that is gone, skips elements or never ends; it mostly "
    "works until the container is large.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("memory",),
    clauses=("cppcheck eraseDereference", "cert CTR51-CPP"),
    bad="void f(std::vector<int> & v) { for (auto it = v.begin(); it != v.end(); ++it) { if (!*it) v.erase(it); } }\n",
    good="void f(std::vector<int> & v) {\n"
    "  for (auto it = v.begin(); it != v.end();) { it = *it < 0 ? v.erase(it) : it + 1; }\n}\n",
    syntax="cpp",
    anchors=("erase",),
    found=found,
)
