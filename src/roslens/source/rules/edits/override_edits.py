"""Edits that say of a function of C++ that it overrides another."""

from __future__ import annotations

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.source.rules.file_view import FileView
from roslens.source.rules.spans import with_space


def override_edits(declaration: Node, declarator: Node, view: FileView) -> tuple[Edit, ...]:
    """Return what adds `override` to a declaration of a function, and takes a `virtual` away that says the same."""
    if not view.is_as_written(declarator) or any("attribute" in one.type for one in declarator.children):
        return ()
    changes = [(declarator.end_byte, declarator.end_byte, " override")]
    changes += [
        (*with_space(view.content, one.start_byte, one.end_byte), "")
        for one in declaration.children
        if one.type == "virtual"
    ]
    return view.edits(*changes)
