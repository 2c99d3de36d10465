"""What a name of C++ is declared as, where the same file tells: a local variable, a parameter, a member."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from tree_sitter import Node

from roslens.source.rules.callbacks import function_name
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import class_name, name_node
from roslens.source.rules.file_view import FileView, all_above

_FUNCTIONS = ("function_definition", "lambda_expression")
_DECLARING = ("declaration", "parameter_declaration", "optional_parameter_declaration", "field_declaration")
_CLASSES = ("class_specifier", "struct_specifier")
_DECLARATORS = ("init_declarator", "reference_declarator", "parenthesized_declarator", "attributed_declarator")


def type_of(name: str, node: Node, view: FileView) -> str:
    """Return the type that a name has at a node, as it is written, without ``const`` and ``&``.

    It is empty where nothing in the file declares the name there, or declares it as ``auto``, as a pointer or array.
    """
    plain = name.removeprefix("this->")
    if not plain.isidentifier():
        return ""
    if plain == name:
        declared = local_declaration(plain, node, view)
        if declared is not None:
            return _type(plain, declared, view)
    found = {_type(plain, one, view) for one in _members(plain, class_around(node, view), view)}
    return found.pop() if len(found) == 1 else ""


def class_around(node: Node, view: FileView) -> str:
    """Return the name of the class whose method is around a node, without its namespace; empty in other functions."""
    for one in all_above(node):
        if one.type == "function_definition":
            return function_name(one, view).rpartition("::")[0].rpartition("::")[2]
        if one.type in _CLASSES:
            return class_name(one, view)
    return ""


def local_declaration(name: str, node: Node, view: FileView) -> Node | None:
    """Return the declaration or parameter of a name that is nearest before a node, in a scope around it."""
    function = next((one for one in all_above(node) if one.type == "function_definition"), None)
    if function is None:
        return None
    found: Node | None = None
    for at in word_places(name.encode(), view, function.start_byte, node.start_byte):
        word = view.node_at(at, at + len(name))
        declaration = declaration_of(word) if word is not None else None
        if declaration is not None and declaration.type != "field_declaration" and _is_seen(declaration, node):
            found = declaration
    return found


def declaration_of(name: Node) -> Node | None:
    """Return the declaration, parameter or member that declares a variable by a name; None for any other use."""
    inner, around = name, name.parent
    while around is not None and around.type in _DECLARATORS:
        if around.type == "init_declarator" and around.child_by_field_name("declarator") != inner:
            return None
        inner, around = around, around.parent
    if around is None or around.type not in _DECLARING:
        return None
    return around if inner in around.children_by_field_name("declarator") else None


def _is_seen(declaration: Node, node: Node) -> bool:
    """Return whether a declaration is in a scope around a node."""
    if declaration.type != "declaration":
        function = next((one for one in all_above(declaration) if one.type in _FUNCTIONS), None)
        return function is not None and function.end_byte >= node.end_byte
    scope = declaration.parent
    return scope is not None and scope.end_byte >= node.end_byte


def _type(name: str, declaration: Node, view: FileView) -> str:
    named = any(view.text(name_node(one)) == name for one in declaration.children_by_field_name("declarator"))
    text = view.text(declaration.child_by_field_name("type")) if named else ""
    return "" if text.startswith(("auto", "decltype")) else text


def _members(name: str, of_class: str, view: FileView) -> Iterator[Node]:
    """Yield the members of a name in the classes of a file, of one name if that is known."""
    for start, end, called in class_extents(view):
        if of_class and called != of_class:
            continue
        for at in word_places(name.encode(), view, start, end):
            word = view.node_at(at, at + len(name))
            if word is None or word.type != "field_identifier":
                continue
            declaration = declaration_of(word)
            if declaration is not None and declaration.type == "field_declaration":
                yield declaration


def class_extents(view: FileView) -> list[tuple[int, int, str]]:
    """Return where classes with a body begin and end, and how they are called."""
    key = "extents of classes"
    found = view.kept.get(key)
    if found is None:
        extents: list[tuple[int, int, str]] = []
        for word in (b"class", b"struct"):
            for at in word_places(word, view):
                token = view.node_at(at, at + len(word))
                cls = token.parent if token is not None else None
                if cls is not None and cls.type in _CLASSES and cls.child_by_field_name("body") is not None:
                    extents.append((cls.start_byte, cls.end_byte, class_name(cls, view)))
        found = view.kept[key] = extents
    return cast("list[tuple[int, int, str]]", found)
