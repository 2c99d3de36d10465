"""Whether a loop is left, or a function, behind a place in C++."""

from __future__ import annotations

from tree_sitter import Node

_LEAVING = ("break_statement", "return_statement", "throw_statement", "goto_statement", "co_return_statement")


def leaves_behind(node: Node, until: Node) -> bool:
    """Return whether control always leaves ``until``, a loop around a node, before it would go on behind the node.

    Only statements that follow in the blocks around the node count, not those in branches beside it.
    """
    inner = node
    while inner.parent is not None and inner != until:
        following = inner.next_named_sibling
        # What follows in a case or block runs behind it; a branch of an `if` beside it does not.
        while following is not None and inner.parent.type in ("compound_statement", "case_statement"):
            if following.type in _LEAVING:
                return True
            following = following.next_named_sibling
        inner = inner.parent
    return False
