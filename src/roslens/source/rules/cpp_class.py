"""What a class of C++ declares, as its own text says."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, cast

from tree_sitter import Node

from roslens.source.rules.file_view import FileView, above

_BODY = "field_declaration_list"
_GROUPS = ("preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif", "template_declaration")
_DECLARATIONS = ("field_declaration", "declaration", "function_definition")
_DECLARATORS = frozenset(
    (
        *("pointer_declarator", "reference_declarator", "array_declarator", "parenthesized_declarator"),
        *("init_declarator", "attributed_declarator"),
    )
)
_NAMING = _DECLARATORS | {"function_declarator"}


class Function(NamedTuple):
    """What a definition of a function names.

    Attributes:
        declarator: of the function; None where there is none.
        named: the node of the name.
        name: as it is written; empty without a node.
    """

    declarator: Node | None
    named: Node | None
    name: str


class Member(NamedTuple):
    """A member of a class.

    Attributes:
        node: its declaration or definition.
        access: ``public``, ``protected`` or ``private``.
        declarator: of a function; None of anything else.
        name: of a function, as it is written; empty of anything else.
        is_template: it stands below a ``template<…>``.
    """

    node: Node
    access: str
    declarator: Node | None
    name: str
    is_template: bool

    @property
    def is_virtual(self) -> bool:
        """Whether it says ``virtual``, ``override`` or ``final``."""
        return has_token(self.node, "virtual") or self.is_override

    @property
    def is_override(self) -> bool:
        """Whether it says ``override`` or ``final``."""
        return self.declarator is not None and any(one.type == "virtual_specifier" for one in self.declarator.children)

    @property
    def is_deleted(self) -> bool:
        """Whether it is ``= delete``."""
        return has_token(self.node, "delete_method_clause")

    @property
    def is_defaulted(self) -> bool:
        """Whether it is ``= default``."""
        return has_token(self.node, "default_method_clause")


def class_name(cls: Node, view: FileView) -> str:
    """Return the name of a class without its template arguments and namespace; empty where it has none."""
    return view.text(cls.child_by_field_name("name")).partition("<")[0].rpartition("::")[2]


def enclosing_class(node: Node) -> Node | None:
    """Return the class whose body a node stands in."""
    return above(node, "class_specifier", "struct_specifier")


def bases_of(cls: Node, view: FileView) -> tuple[str, ...]:
    """Return the names of the direct base classes as they are written."""
    clause = next((one for one in cls.children if one.type == "base_class_clause"), None)
    if clause is None:
        return ()
    return tuple(view.text(one) for one in clause.named_children if one.type != "access_specifier")


def members_of(cls: Node, view: FileView) -> tuple[Member, ...]:
    """Return what the body of a class declares, in order; what stands in ``#if`` as well."""
    key = ("members", cls.start_byte, cls.type)
    found = view.kept.get(key)
    if found is None:
        found = view.kept[key] = tuple(_members(cls, view))
    return cast("tuple[Member, ...]", found)


def _members(cls: Node, view: FileView) -> Iterator[Member]:
    body = cls.child_by_field_name("body")
    if body is None:
        return
    access = "private" if cls.type == "class_specifier" else "public"
    waiting = [(one, False) for one in reversed(body.children)]
    while waiting:
        node, is_template = waiting.pop()
        if node.type == "access_specifier":
            access = view.text(node).partition(" ")[0].rstrip(":")
        elif node.type in _DECLARATIONS:
            declarator = function_declarator(node)
            yield Member(node, access, declarator, view.text(name_node(declarator)), is_template)
        elif node.type in _GROUPS:
            inside = is_template or node.type == "template_declaration"
            waiting.extend((one, inside) for one in reversed(node.children))


def function_declarator(node: Node) -> Node | None:
    """Return the declarator of the function that a declaration or definition names; None of a variable."""
    found = node.child_by_field_name("declarator")
    while found is not None and found.type != "function_declarator":
        if found.type not in _DECLARATORS or found.type == "parenthesized_declarator":
            return None
        inner = found.child_by_field_name("declarator")
        found = inner or next((one for one in found.named_children if one.type.endswith("declarator")), None)
    if found is not None:
        named = found.child_by_field_name("declarator")
        if named is not None and named.type == "parenthesized_declarator":
            return None
    return found


def function_of(definition: Node, view: FileView) -> Function:
    """Return what a definition of a function names, found once for all rules."""
    key = ("function", definition.id)
    found = view.kept.get(key)
    if found is None:
        declarator = function_declarator(definition)
        named = name_node(declarator)
        found = view.kept[key] = Function(declarator, named, view.text(named))
    return cast("Function", found)


def name_node(declarator: Node | None) -> Node | None:
    """Return the node of the name that a declarator declares."""
    while declarator is not None and declarator.type in _NAMING:
        inner = declarator.child_by_field_name("declarator")
        declarator = inner or next((one for one in declarator.named_children if one.type != "type_qualifier"), None)
    return declarator


def parameters_of(declarator: Node) -> list[Node]:
    """Return the parameters of a function, none for ``void``; ``...`` is no parameter."""
    listed = declarator.child_by_field_name("parameters")
    if listed is None:
        return []
    found = [one for one in listed.named_children if one.type.endswith("parameter_declaration")]
    if len(found) == 1 and found[0].named_child_count == 1 and found[0].type == "parameter_declaration":
        (only,) = found[0].named_children
        if only.type == "primitive_type" and only.text == b"void":
            return []
    return found


def has_token(node: Node, kind: str) -> bool:
    """Return whether a node has a child of a type, such as the token ``virtual``."""
    return any(one.type == kind for one in node.children)


def is_static(node: Node) -> bool:
    """Return whether a declaration says ``static``."""
    return any(one.type == "storage_class_specifier" and one.text == b"static" for one in node.children)
