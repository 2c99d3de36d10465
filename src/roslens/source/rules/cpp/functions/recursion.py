"""Rule ``cpp.recursion``: a function that calls itself."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import function_of, parameters_of
from roslens.source.rules.cpp_statement import arguments_of
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_LIST = re.compile(rb"\s*(\([^()]*\))\s*(?:const)?\s*[{:]")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call of the function around it."""
    body = node.child_by_field_name("body")
    declarator, _, name = function_of(node, view)
    last = name.rpartition("::")[2]
    if body is None or declarator is None or not last.isidentifier():
        return
    if view.code.find(last.encode(), body.start_byte, body.end_byte) < 0:
        return
    parameters = parameters_of(declarator)
    least = sum(one.type == "parameter_declaration" for one in parameters)
    word, owner = last.encode(), name.rpartition("::")[0].encode()
    for at in word_places(word, view, body.start_byte, body.end_byte):
        call = None if _is_of_another(at, owner, view) else _call_at(at, at + len(word), view)
        if call is not None and least <= len(arguments_of(call)) <= len(parameters):
            # Which of several functions of one name is called, types decide.
            if _heads(last, view) > 1:
                return
            yield view.hit("cpp.recursion", call, f"`{last}` calls itself; expected a loop, or a bound on the depth")
            return


def _is_of_another(at: int, owner: bytes, view: FileView) -> bool:
    """Whether the name that begins at ``at`` is asked of something else than this object, or its class ``owner``."""
    before = view.code[max(at - 80, 0) : at].rstrip()
    if not before.endswith((b".", b"->", b"::", b"~")):
        return False
    return not before.endswith((b"this->", b"this ->", owner + b"::" if owner else b"this->"))


def _call_at(start: int, end: int, view: FileView) -> Node | None:
    """Return the call of what is named from ``start`` to ``end``, if it is called there."""
    node = view.node_at(start, end)
    call = above(node, "call_expression") if node is not None else None
    function = call.child_by_field_name("function") if call is not None else None
    return call if function is not None and function.end_byte == end else None


def _heads(name: str, view: FileView) -> int:
    """Return how many functions of a name the file has; most have one, which the search from lines need not tell."""
    word, code = name.encode(), view.code
    lists, at = set(), code.find(word)
    while at >= 0:
        match = _LIST.match(code, at + len(word))
        if match is not None:
            lists.add(match[1])
        at = code.find(word, at + 1)
    if len(lists) < 2:
        return len(lists)
    head = rb"^(?!\s*return)[\w:<>,&* ]*[\w&*>]\s+(?:\w+::)*%s\s*(\([^()]*\))\s*(?:const)?\s*[{:]"
    return len(set(re.findall(head % word, code, re.MULTILINE)))


RULE = FileRule(
    id="cpp.recursion",
    title="Function that calls itself",
    finds="A function that calls itself with as many arguments as it takes. Use a loop, or a bound on the depth.",
    why="How much stack it takes is up to the data: a deep tree or a long path ends the node.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 7-5-4",
        "misra-cpp-2023 8.2.10",
        "autosar-cpp14 A7-5-2",
        "jsf-av 119",
        "hicpp 5.2.2",
        "clang-tidy misc-no-recursion",
    ),
    bad="int factorial(int n) { return n ? n * factorial(n - 1) : 1; }\n",
    good="int factorial(int n) { int r = 1; while (n) r *= n--; return r; }\n",
    syntax="cpp",
    kinds=("function_definition",),
    found=found,
)
