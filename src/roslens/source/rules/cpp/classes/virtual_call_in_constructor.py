"""Rule ``cpp.virtual_call_in_constructor``: a call that does not reach the derived class."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import cast

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import Member, class_name, has_token, members_of
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_CALLED = re.compile(rb"(?<![\w.>:])(?:this\s*->\s*)?\b(\w+)\s*\(")
_OF_ITS_CLASS = re.compile(rb"(?<![\w\x80-\xff])([\w\x80-\xff]+)\s*::\s*~?\1\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call of a virtual member in the body of a constructor or destructor."""
    if view.code.find(b"virtual", node.start_byte, node.end_byte) < 0:
        return
    name = class_name(node, view)
    virtual, functions = set(), []
    for member in members_of(node, view):
        if member.declarator is None:
            continue
        if member.name in (name, f"~{name}"):
            functions.append(member.node)
        elif has_token(member.node, "virtual") and not _is_final(member):
            virtual.add(member.name.encode())
    if not virtual or has_token(node, "virtual_specifier") or not name:
        return
    for function in (*functions, *_outside(name, view)):
        body = function.child_by_field_name("body")
        for call, called in _calls(body, virtual, view) if body is not None else ():
            yield view.hit(
                "cpp.virtual_call_in_constructor",
                call,
                f"`{called}` is virtual, but in `{name}`'s constructor or destructor only `{name}::{called}` runs",
            )


def _calls(body: Node, names: Collection[bytes], view: FileView) -> Iterator[tuple[Node, str]]:
    """Yield the calls of members of these names in a body, outside of its lambdas."""
    for match in _CALLED.finditer(view.code, body.start_byte, body.end_byte):
        call = _call_at(match, view) if match[1] in names else None
        if call is not None and not above_lambda(call, body):
            yield call, match[1].decode("utf-8", "replace")


def _call_at(match: re.Match[bytes], view: FileView) -> Node | None:
    """Return the call of the name that a match found, if it is called there."""
    at = view.node_at(match.start(1), match.end(1))
    call = above(at, "call_expression", "lambda_expression", "function_definition") if at is not None else None
    if call is None or call.type != "call_expression":
        return None
    callee = call.child_by_field_name("function")
    return call if callee is not None and callee.end_byte == match.end(1) else None


def _is_final(member: Member) -> bool:
    return member.declarator is not None and any(one.text == b"final" for one in member.declarator.children)


def above_lambda(call: Node, body: Node) -> bool:
    """Return whether the call runs later, in a lambda."""
    around = above(call, "lambda_expression")
    return around is not None and around.start_byte > body.start_byte


def _outside(name: str, view: FileView) -> Iterator[Node]:
    for start, end in _constructors(view).get(name.encode(), ()):
        at = view.node_at(start, end)
        function = at if at is None or at.type == "function_definition" else above(at, "function_definition")
        if function is not None:
            yield function


def _constructors(view: FileView) -> Mapping[bytes, Sequence[tuple[int, int]]]:
    """Return where constructors and destructors are defined outside of their class, by its name."""
    known = view.kept.get("constructors outside")
    if known is None:
        found: dict[bytes, list[tuple[int, int]]] = {}
        for match in _OF_ITS_CLASS.finditer(view.code):
            found.setdefault(match[1], []).append(match.span())
        known = view.kept["constructors outside"] = found
    return cast("Mapping[bytes, Sequence[tuple[int, int]]]", known)


RULE = FileRule(
    id="cpp.virtual_call_in_constructor",
    title="Virtual function called in a constructor",
    finds="A constructor or destructor calls a virtual function of its own class by name. The function of the "
    "class itself runs, not of the one that is being built. Call it qualified, or from a separate `init`.",
    why="A driver that overrides `connect` never gets there when the base connects in its constructor.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 12-1-1",
        "misra-cpp-2023 15.1.1",
        "autosar-cpp14 M12-1-1",
        "jsf-av 71.1",
        "hicpp 12.4.1",
        "clang-tidy clang-analyzer-optin.cplusplus.VirtualCall",
    ),
    bad="struct A { A() { connect(); } virtual void connect(); };\n",
    good="struct A { A() { A::connect(); } virtual void connect(); };\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier"),
    found=found,
)
