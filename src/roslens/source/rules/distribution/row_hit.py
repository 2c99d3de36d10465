"""A hit about a row of the tables of distributions."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.distributions.read_changes import Change
from roslens.source.rules.file_view import FileView, all_above

_CHOICES = (b"#else", b"#elif", b"DISTRO", b"ROS_VERSION", b"has_include", b"_VERSION")


def is_chosen(node: Node, view: FileView) -> bool:
    """Tell whether the preprocessor chooses, by distribution or by what there is, whether a node is compiled."""
    for one in all_above(node):
        if one.type.startswith("preproc_if"):
            text = view.source[one.start_byte : one.end_byte]
            if any(word in text for word in _CHOICES):
                return True
    return False


def row_message(change: Change, written: str) -> str:
    """Return what is said of a row that a place uses."""
    return f"`{written}` is {change.text()}"
