"""Parts of definitions of C++: guards of headers, functions that are a ``try``, arguments of bases."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.extract.lowering.cpp.cpp_types import name_and_templates

HANDING = ("reference_declarator", "pointer_declarator")
"""Declarators of functions that return what may be changed."""
_BASES = frozenset({"type_identifier", "qualified_identifier", "template_type"})


def is_guard(condition: Node | None, inner: list[Node], source: bytes) -> bool:
    """Whether a condition of the preprocessor guards a header: it asks for what comes first in it."""
    first = next((child for child in inner if child.type != "comment"), None)
    if condition is None or first is None or first.type != "preproc_def":
        return False
    name = first.child_by_field_name("name")
    asked = source[condition.start_byte : condition.end_byte].strip()
    return name is not None and source[name.start_byte : name.end_byte] == asked


def tried_body(definition: Node) -> Node | None:
    """Return the body of a function that is a ``try`` as a whole."""
    return next((one for one in definition.named_children if one.type == "try_statement"), None)


def base_arguments(node: Node, source: bytes) -> tuple[tuple[str, ...], ...]:
    """Return the template arguments of each base of a class; empty where none has any."""
    clause = next((child for child in node.named_children if child.type == "base_class_clause"), None)
    if clause is None or b"<" not in source[clause.start_byte : clause.end_byte]:
        return ()
    bases = [one for one in clause.named_children if one.type in _BASES]
    return tuple(name_and_templates(source[one.start_byte : one.end_byte])[1] for one in bases)
