"""The local variable of C++ that alone keeps what a call returns, and how long it does."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from tree_sitter import Node

from roslens.source.rules.callbacks import callee_name, function_name
from roslens.source.rules.calls import function_around, receiver
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.file_view import FileView, all_above

_STAYS = re.compile(
    rb"spin|\bwait|\bsleep|\bok\s*\(|\bjoin\s*\(|\bget\s*\(\s*\)|\b(?:run|exec|loop)\w*\s*\(|\bwhile\b|\bfor\s*\(\s*;\s*;"
)
"""What a function or block does that does not end at once, so that what it holds is of use while it lasts."""
_ENDED = frozenset(("cancel", "shutdown", "stop", "reset"))
"""Methods by which a handle is ended on purpose."""
_ADDING = frozenset(("push_back", "emplace_back", "insert", "emplace"))
_BLOCK = "compound_statement"
_HELD = ("static", "thread_local", "extern")


class Keeper(NamedTuple):
    """A local variable that keeps what a call returns.

    Attributes:
        name: of it.
        declaration: of it.
        block: in which it is declared; with it, it ends.
        call: what it keeps the result of.
    """

    name: str
    declaration: Node
    block: Node
    call: Node

    @property
    def scope_kind(self) -> str:
        """What it ends with, in a word."""
        around = self.block.parent
        return (
            "function"
            if around is not None and around.type in ("function_definition", "lambda_expression")
            else "block"
        )

    def ends_early(self, view: FileView) -> bool:
        """Return whether it ends at once, as far as is seen: nothing waits in its block, and nothing else gets it."""
        function = function_around(self.call)
        if function is None or _STAYS.search(view.code[self.block.start_byte : self.block.end_byte]):
            return False
        if self.scope_kind == "function" and (
            function.type != "function_definition" or not _is_of_class(function, view)
        ):
            return False
        return not any(_is_passed_on(use, view) for use in self.uses(view))

    def uses(self, view: FileView) -> Iterator[Node]:
        """Yield where the variable is named behind its declaration."""
        word = self.name.encode()
        for at in word_places(word, view, self.declaration.end_byte, self.block.end_byte):
            use = view.node_at(at, at + len(word))
            if use is not None:
                yield use


def keeper_of(call: Node, view: FileView) -> Keeper | None:
    """Return the local variable that is made with what a call returns, is assigned it, or is a container given it."""
    around = call.parent
    if around is None:
        return None
    if around.type == "init_declarator":
        declaration = around.parent
        name = view.text(name_node(around.child_by_field_name("declarator")))
        return _keeper(name, declaration, call, view)
    if around.type == "assignment_expression" and around.child_by_field_name("right") == call:
        name = view.text(around.child_by_field_name("left"))
        return _keeper(name, _declaration_of(name, call, view), call, view)
    adding = around.parent if around.type == "argument_list" else None
    if adding is not None and adding.type == "call_expression" and callee_name(adding, view) in _ADDING:
        name = view.text(receiver(adding))
        return _keeper(name, _declaration_of(name, call, view), call, view)
    return None


def declared_keeper(declaration: Node, view: FileView) -> Keeper | None:
    """Return the variable of a declaration that makes an object itself: ``T name(value);``."""
    name = name_node(declaration.child_by_field_name("declarator"))
    return _keeper(view.text(name), declaration, declaration, view)


def _keeper(name: str, declaration: Node | None, call: Node, view: FileView) -> Keeper | None:
    block = declaration.parent if declaration is not None else None
    if declaration is None or block is None or block.type != _BLOCK or not name.isidentifier():
        return None
    if view.text(declaration).startswith(_HELD) or _is_reference(declaration):
        return None
    return Keeper(name, declaration, block, call)


def _is_reference(declaration: Node) -> bool:
    declarator = declaration.child_by_field_name("declarator")
    inner = declarator.child_by_field_name("declarator") if declarator is not None else None
    return any(one is not None and one.type == "reference_declarator" for one in (declarator, inner))


def _declaration_of(name: str, node: Node, view: FileView) -> Node | None:
    """Return the declaration of a variable in a block around a node, in the same function."""
    if not name.isidentifier():
        return None
    for block in all_above(node):
        if block.type in ("function_definition", "lambda_expression"):
            return None
        if block.type != _BLOCK:
            continue
        for at in word_places(name.encode(), view, block.start_byte, node.start_byte):
            word = view.node_at(at, at + len(name))
            declaration = _declaring(word) if word is not None else None
            if declaration is not None and declaration.parent == block:
                return declaration
    return None


def _declaring(name: Node) -> Node | None:
    """Return the declaration of which a node is the name that it declares."""
    inner, around = name, name.parent
    while around is not None and around.type != "declaration":
        if around.child_by_field_name("declarator") != inner and not around.type.endswith("declarator"):
            return None
        inner, around = around, around.parent
    if around is None or inner not in around.children_by_field_name("declarator"):
        return None
    return around if name_node(inner) == name else None


def _is_of_class(function: Node, view: FileView) -> bool:
    """Return whether a function is a method, whose object lives on when it has returned."""
    return "::" in function_name(function, view)


def _is_passed_on(use: Node, view: FileView) -> bool:
    """Return whether a use of a variable may keep it longer, or ends it on purpose."""
    around = use.parent
    if around is None:
        return True
    if around.type == "assignment_expression":
        return around.child_by_field_name("left") != use
    if around.type == "field_expression" and around.child_by_field_name("argument") == use:
        return view.text(around.child_by_field_name("field")) in _ENDED
    if around.type == "cast_expression":
        return view.text(around.child_by_field_name("type")) != "void"
    return around.type not in ("condition_clause", "unary_expression")
