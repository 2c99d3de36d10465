"""With what a variable of C++ is made where the grammar reads ``T name(value);`` as the declaration of a function."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from roslens.source.rules.calls import constructed, whole_name
from roslens.source.rules.file_view import above


def made_with(name: Node) -> Sequence[Node] | None:
    """Return the arguments with which the type that ends in ``name`` is constructed, None where it is not.

    In a function, ``T name(value);`` declares a variable: what looks like the type of a parameter is the value then.
    """
    given = constructed(name)
    if given is not None:
        return given
    whole = whole_name(name)
    around = whole.parent
    if around is None or around.type != "declaration" or around.child_by_field_name("type") != whole:
        return None
    declarator = around.child_by_field_name("declarator")
    if declarator is None or declarator.type != "function_declarator" or above(around, "compound_statement") is None:
        return None
    listed = declarator.child_by_field_name("parameters")
    found = []
    for one in listed.named_children if listed is not None else ():
        if one.type != "parameter_declaration" or one.named_child_count != 1:
            return None
        found.append(one.named_children[0])
    return found or None
