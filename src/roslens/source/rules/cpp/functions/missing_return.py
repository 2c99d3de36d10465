"""Rule ``cpp.missing_return``: a function that returns a value and forgets to."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import function_declarator, name_node
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ENDS = re.compile(
    rb"\b(?:return|co_return|co_yield|co_await|throw|exit|_exit|abort|terminate|asm|goto|longjmp|exec[lv]\w*|[A-Za-z_]*(?:RETURN|THROW|FAIL|ASSERT|ABORT|UNREACHABLE|FATAL|NOT_IMPLEMENTED)[A-Z_]*|__builtin_\w+|unreachable)\b"
    rb"|\b(?:while|for)\s*\(\s*(?:1|true|;\s*;)\s*\)|#"
)
_OPEN = re.compile(rb"\bgoto\b|\basm\b|#|\bco_return\b|\bco_yield\b|\bco_await\b")
"""With it in a body nobody knows where it ends."""
_NO_WAY_BACK = re.compile(r"(?i)error|fatal|fail|die$|panic|abort|exit|throw|raise|unreachable|terminate|assert|check")
"""In the name of a function that may not return."""
_GOING_ON = frozenset({"expression_statement", "declaration", "for_range_loop", "do_statement"})
_MACRO = re.compile(r"[A-Z][A-Z0-9_]+")

_CALLED = re.compile(r"([A-Za-z_]\w*)\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a function that has a type of result and a body, and never returns one, or not at its end."""
    body = node.child_by_field_name("body")
    if body is None or body.type != "compound_statement" or not body.named_child_count:
        return
    returns = view.code.find(b"return", body.start_byte, body.end_byte) >= 0
    if not _falls_off(body, view) if returns else _never_ends(body, view):
        return
    named = _named(node, view)
    if named is None:
        return
    function, name, text = named
    what = f"`{name}` returns {text} but has no `return`; expected one, or `void`"
    if returns:
        line = _last(body).end_point[0] + 1
        what = f"`{name}` returns {text}, and its end is reached behind line {line}; expected a `return` there"
    yield view.hit("cpp.missing_return", function, what)


def _named(node: Node, view: FileView) -> tuple[Node, str, str] | None:
    """Return declarator, name and type of result of a function that has to return a value."""
    kind, declarator = node.child_by_field_name("type"), node.child_by_field_name("declarator")
    function = function_declarator(node)
    if kind is None or declarator is None or function is None or node.has_error:
        return None
    text = view.text(kind) + (" *" if declarator.type == "pointer_declarator" else "")
    if not _is_result(text) or (node.type == "function_definition" and "noreturn" in view.short(node)):
        return None
    name = view.text(name_node(function))
    if name in ("main", "wmain", text) or "~" in name or _MACRO.fullmatch(name):
        return None
    written = view.text(declarator) if declarator.type == "function_declarator" else ""
    return None if "->" in written and "void" in written else (function, name, text)


def _last(body: Node) -> Node:
    """Return the last statement of a body, or the body where it has none."""
    return next((one for one in reversed(body.named_children) if one.type != "comment"), body)


def _falls_off(body: Node, view: FileView) -> bool:
    """Return whether the end of a body is reached, as its last statement tells: one that always goes on."""
    last = _last(body)
    if last.type not in _GOING_ON or any(one.type == "return_statement" for one in body.named_children):
        return False
    called = _CALLED.findall(view.text(last)) if last.type == "expression_statement" else []
    if any(map(_NO_WAY_BACK.search, called)):
        return False
    # A loop may return, and go on all the same.
    if not last.type.startswith("for") and _ENDS.search(view.code, last.start_byte, last.end_byte):
        return False
    return not _OPEN.search(view.code, body.start_byte, body.end_byte) and not _ends_in_macro(body, view)


def _is_result(text: str) -> bool:
    """Whether a type is certainly one of which a value has to be returned."""
    # An alias of a header that is not read: `simxVoid`.
    if text.lower().endswith("void"):
        return False
    if text in ("auto", "noreturn", "decltype(auto)", "else", "do", "try") or _MACRO.fullmatch(text):
        return False
    return not any(one in text for one in ("NORETURN", "enable_if", "disable_if"))


def _never_ends(body: Node, view: FileView) -> bool:
    """Whether a body is empty, or ends otherwise than at its end, as far as that can be seen."""
    if _ENDS.search(view.code, body.start_byte, body.end_byte):
        return True
    return all(one.type == "comment" for one in body.named_children) or _ends_in_macro(body, view)


def _ends_in_macro(body: Node, view: FileView) -> bool:
    """Return whether the last statement is a macro, which may return: ``PYBIND11_OVERRIDE(bool, Base, apply);``."""
    last = [one for one in body.named_children if one.type != "comment"][-1]
    called = _CALLED.match(view.text(last))
    return called is not None and _MACRO.fullmatch(called[1]) is not None


RULE = FileRule(
    id="cpp.missing_return",
    title="No `return` in a function that has a value",
    finds="A function with a result whose body has statements, but no `return`, no `throw` and nothing that "
    "ends the process, or whose last statement goes on to its end. Return something. In a function that nothing in the "
    "package calls, and no other package can, it is a note.",
    why="The value is whatever lies in a register: compilers may even remove the end of the function, and the "
    "node runs into the next one.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 8-4-3",
        "misra-cpp-2023 9.6.5",
        "autosar-cpp14 A8-4-2",
        "jsf-av 114",
        "hicpp 6.3.2",
        "clang-tidy clang-diagnostic-return-type",
    ),
    bad="bool stop() { engine(0); }\n",
    good="bool stop() { return engine(0); }\n",
    syntax="cpp",
    kinds=("function_definition",),
    found=found,
)
