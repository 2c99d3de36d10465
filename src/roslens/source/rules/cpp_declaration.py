"""What a local declaration of C++ names, and which names the scopes around it have: worked out once for all rules."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from operator import attrgetter
from typing import NamedTuple, cast

from tree_sitter import Node

from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import function_of, name_node, parameters_of
from roslens.source.rules.file_view import FileView

_SCOPES = ("compound_statement", "for_statement", "for_range_loop", "if_statement", "while_statement")
_START = attrgetter("start_byte")
_ENDS = ("function_definition", "lambda_expression", "class_specifier", "struct_specifier")

_WORD = re.compile(rb"[\w\x80-\xff]+")
_NEAR = 10_000
"""Within so many bytes a word is looked for anew each time."""

_Names = Mapping[str, tuple[int, Node]]


class Declared(NamedTuple):
    """A name that a declaration declares.

    Attributes:
        declarator: as it stands there.
        named: the node of the name; None where there is none.
        name: as it is written; empty without a node.
    """

    declarator: Node
    named: Node | None
    name: str


class Declaration(NamedTuple):
    """A declaration.

    Attributes:
        node: of it.
        names: that it declares, in order.
    """

    node: Node
    names: Sequence[Declared]


def declarations(view: FileView) -> Mapping[int, Declaration]:
    """Return what the nodes of type ``declaration`` of a file declare, in order, by the ids of these nodes.

    The rule that asks has to gather them.
    """
    found = view.kept.get("declarations")
    if found is None:
        nodes = sorted(view.nodes("declaration"), key=_START)
        found = view.kept["declarations"] = {node.id: _declaration(node, view) for node in nodes}
    return cast("Mapping[int, Declaration]", found)


def _declaration(node: Node, view: FileView) -> Declaration:
    names = []
    for declarator in node.children_by_field_name("declarator"):
        named = name_node(declarator)
        names.append(Declared(declarator, named, view.text(named)))
    return Declaration(node, names)


def hidden_by(name: str, declaration: Declaration, view: FileView) -> Node | None:
    """Return the declaration of the same name in a scope around that of a local one, or its parameter.

    The rule that asks has to gather ``declaration`` and ``function_definition``.
    """
    # What stands around a node is asked from the root of the tree on; most names are new in their function.
    if not _is_named_before(name.encode(), declaration.node.start_byte, view):
        return None
    around = declaration.node.parent
    if around is None or around.type not in _SCOPES:
        return None
    for names, inside in _scopes_around(around, view):
        known = names.get(name)
        if known is not None and known[0] < inside:
            return known[1]
    return None


def _is_named_before(word: bytes, end: int, view: FileView) -> bool:
    """Return whether a word stands before a place: in the function around it, or near by where there is none."""
    starts, ends = _outermost(view)
    place = bisect_right(starts, end) - 1
    start = starts[place] if place >= 0 else 0
    if place < 0 or ends[place] <= end:
        # Outside of functions only a lambda has local names.
        start = max(start, end - _NEAR)
    elif end - start > _NEAR:
        return _first_places(start, ends[place], view).get(word, end) < end
    # Most are not there at all, and to ask for places begins a walk.
    return view.code.find(word, start, end) >= 0 and any(True for _ in word_places(word, view, start, end))


def _outermost(view: FileView) -> tuple[Sequence[int], Sequence[int]]:
    """Return where functions begin that stand in no other, and where they end."""
    found = view.kept.get("outermost functions")
    if found is None:
        starts: list[int] = []
        ends: list[int] = []
        for start, end in sorted(one.byte_range for one in view.nodes("function_definition")):
            if not ends or start >= ends[-1]:
                starts.append(start)
                ends.append(end)
        found = view.kept["outermost functions"] = (starts, ends)
    return cast("tuple[Sequence[int], Sequence[int]]", found)


def _first_places(start: int, end: int, view: FileView) -> Mapping[bytes, int]:
    """Return where each word of a long function stands first."""
    key = ("first places", start)
    found = view.kept.get(key)
    if found is None:
        places: dict[bytes, int] = {}
        for match in _WORD.finditer(view.code, start, end):
            places.setdefault(match.group(), match.start())
        found = view.kept[key] = places
    return cast("Mapping[bytes, int]", found)


def _scopes_around(scope: Node, view: FileView) -> Sequence[tuple[_Names, int]]:
    """Return the names of the scopes around one, the nearest first, each with where the way to it begins there."""
    key = ("scopes around", scope.id)
    found = view.kept.get(key)
    if found is None:
        chain: list[tuple[_Names, int]] = []
        inside, one = scope, scope.parent
        while one is not None:
            kind = one.type
            if kind in _ENDS:
                if kind == "function_definition":
                    chain.append((_parameters(one, view), one.end_byte))
                break
            if kind in _SCOPES:
                chain.append((_names(one, view), inside.start_byte))
            inside, one = one, one.parent
        found = view.kept[key] = chain
    return cast("Sequence[tuple[_Names, int]]", found)


def _parameters(function: Node, view: FileView) -> _Names:
    declarator = function_of(function, view).declarator
    found: dict[str, tuple[int, Node]] = {}
    for one in parameters_of(declarator) if declarator is not None else ():
        name = view.text(name_node(one.child_by_field_name("declarator"))).lstrip("&* ")
        found.setdefault(name, (one.start_byte, one))
    return found


def _names(scope: Node, view: FileView) -> _Names:
    key = ("names", scope.id)
    known = view.kept.get(key)
    if known is None:
        found: dict[str, tuple[int, Node]] = {}
        for one in scope.named_children:
            if one.type == "declaration":
                for each in declarations(view)[one.id].names:
                    found.setdefault(each.name, (one.start_byte, one))
        known = view.kept[key] = found
    return cast("_Names", known)
