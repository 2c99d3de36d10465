"""Rule ``cpp.copies_owner``: a class that frees what its copies free again."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import Member, bases_of, class_name, is_static, members_of, name_node, parameters_of
from roslens.source.rules.file_view import FileView, above, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_FREES = re.compile(rb"\bdelete\b|\bfree\s*\(|\bf?close\s*\(")
_DESTRUCTOR = re.compile(rb"\s*::\s*~\s*([^\s(]+)\s*\(")
_MACROS = (b"DISALLOW_COPY", b"NON_COPYABLE", b"NONCOPYABLE", b"Q_DISABLE_COPY", b"Q_OBJECT", b"DISABLE_COPY")
_OWNERS = (
    b"unique_ptr",
    b"scoped_ptr",
    b"std::mutex",
    b"std::thread",
    b"recursive_mutex",
    b"std::atomic",
    b"boost::mutex",
    b"scoped_thread",
    b"boost::thread ",
    b"ifstream",
    b"ofstream",
    b"NodeHandle &",
    b"condition_variable",
    b"std::future",
    b"std::promise",
    b"ClassLoader<",
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a class that frees a member in its destructor and does not say how it is copied."""
    # A base class may forbid copies: noncopyable, QObject, Nodelet.
    if view.code.find(b"~", node.start_byte, node.end_byte) < 0 or bases_of(node, view):
        return
    name = class_name(node, view)
    destructor = None
    for member in members_of(node, view):
        if member.name == f"~{name}":
            destructor = member.node
        elif _says_how_to_copy(member, name, view):
            return
    if destructor is None:
        return
    body = view.code[node.start_byte : node.end_byte]
    if any(one in body for one in (*_MACROS, *_OWNERS)) or not _pointers(node, view):
        return
    freed = _freed(destructor, name, view)
    if freed and freed in _pointers(node, view):
        at = node.child_by_field_name("name") or node
        yield view.hit(
            "cpp.copies_owner",
            at,
            f"`~{name}` deletes `{freed}`, which copies share; expected a std::unique_ptr, or copying deleted",
            certainty=None if view.may_be_header else Certainty.HEURISTIC,
        )


def _says_how_to_copy(member: Member, name: str, view: FileView) -> bool:
    if member.name.replace(" ", "") == "operator=":
        return True
    parameters = parameters_of(member.declarator) if member.declarator is not None and member.name == name else []
    if not parameters:
        return False
    return view.text(parameters[0].child_by_field_name("type")).partition("<")[0].rpartition("::")[2] == name


def _pointers(cls: Node, view: FileView) -> set[str]:
    found = set()
    for member in members_of(cls, view):
        if member.node.type != "field_declaration" or member.declarator is not None or is_static(member.node):
            continue
        for one in member.node.children_by_field_name("declarator"):
            if one.type == "pointer_declarator":
                found.add(view.text(name_node(one)))
    return found


def _freed(destructor: Node, name: str, view: FileView) -> str:
    body = destructor.child_by_field_name("body")
    if body is None:
        body = _defined_elsewhere(name, view)
    for one in below(body, "delete_expression") if body is not None else ():
        operand = one.named_children[-1] if one.named_child_count else None
        if operand is not None:
            return view.text(operand).removeprefix("this->")
    return ""


def _defined_elsewhere(name: str, view: FileView) -> Node | None:
    word = name.encode()
    for at in word_places(word, view):
        match = _DESTRUCTOR.match(view.code, at + len(word))
        if match is not None and match[1] == word:
            node = view.node_at(at, match.end())
            function = above(node, "function_definition") if node is not None else None
            return function.child_by_field_name("body") if function is not None else None
    return None


RULE = FileRule(
    id="cpp.copies_owner",
    title="Class that deletes, and can be copied",
    finds="A class whose destructor deletes or frees a member, and that declares neither a copy constructor nor "
    "a copy assignment, nor forbids them. Hold the member in a `std::unique_ptr`, or delete both.",
    why="A copy, such as one made by putting the object into a vector, frees the same memory or handle twice; "
    "nodes die of it minutes later.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "hicpp 12.5.1",
        "autosar-cpp14 A12-0-1",
        "misra-cpp-2023 15.0.1",
        "jsf-av 76",
        "clang-tidy cppcoreguidelines-special-member-functions",
    ),
    bad="class Buffer {\n"
    " public:\n"
    "  Buffer() : data_(new char[64]) {}\n"
    "  ~Buffer() { delete[] data_; }\n"
    " private:\n"
    "  char* data_;\n"
    "};\n",
    good="class Buffer {\n"
    " public:\n"
    "  Buffer() : data_(new char[64]) {}\n"
    "  ~Buffer() { delete[] data_; }\n"
    "  Buffer(const Buffer&) = delete;\n"
    "  Buffer& operator=(const Buffer&) = delete;\n"
    " private:\n"
    "  char* data_;\n"
    "};\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier"),
    found=found,
)
