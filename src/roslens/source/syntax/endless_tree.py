"""Trees that no query comes to the end of: too deep, or with too much beside each other that is no source.

Its time grows with the square of either, and below 65,535 levels it never ends. Source that people write nests some
hundred levels, generated chains of operators and ``else if`` some thousand.
"""

from __future__ import annotations

from tree_sitter import Node, Tree

from roslens.intake.time_budget import OverBudgetError

MOST_LEVELS = 60_000


def refuse_endless(tree: Tree) -> None:
    """Look for a node below more than :data:`MOST_LEVELS` others, and for an error of more than so many parts.

    A node that is no longer than the levels that are left cannot hold one, so that little of a tree is looked at.

    Raises:
        OverBudgetError: there is one.
    """
    waiting: list[tuple[Node, int]] = [(tree.root_node, 0)]
    while waiting:
        node, level = waiting.pop()
        if level > MOST_LEVELS:
            raise OverBudgetError(f"it is nested more than {MOST_LEVELS:,} levels deep")
        if node.is_error and node.child_count > MOST_LEVELS:
            raise OverBudgetError(f"more than {MOST_LEVELS:,} signs and words in a row make no sense")
        room = MOST_LEVELS - level
        if node.end_byte - node.start_byte > room:
            waiting += [(child, level + 1) for child in node.children if child.end_byte - child.start_byte > room - 1]
