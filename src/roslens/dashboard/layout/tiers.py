"""Which packages are built on which: cycles, tiers and the edges that are not redundant.

Nodes are numbers from 0; an edge (a, b) means that a needs b. The tier of a node is the number of edges on the longest
way down from it, with each cycle taken as one node: what needs nothing is in tier 0.
"""

from __future__ import annotations

from collections.abc import Sequence

from roslens.model.relations.strongly_connected import strongly_connected

Edge = tuple[int, int]


def needs_of(count: int, edges: Sequence[Edge]) -> list[list[int]]:
    """Return for each node what it needs, sorted, without repeats and without itself."""
    needs: list[set[int]] = [set() for _ in range(count)]
    for dependent, needed in edges:
        if dependent != needed:
            needs[dependent].add(needed)
    return [sorted(targets) for targets in needs]


def cycles_of(needs: Sequence[Sequence[int]]) -> list[int]:
    """Return for each node the number of its strongly connected component.

    Components are numbered so that what is needed comes before what needs it.
    """
    component = [-1] * len(needs)
    for number, members in enumerate(strongly_connected(range(len(needs)), needs.__getitem__)):
        for node in members:
            component[node] = number
    return component


def condense(needs: Sequence[Sequence[int]], component: Sequence[int]) -> list[list[int]]:
    """Return what each component needs of the others."""
    count = max(component, default=-1) + 1
    return needs_of(
        count,
        [(component[node], component[target]) for node, targets in enumerate(needs) for target in targets],
    )


def tiers_of(needs: Sequence[Sequence[int]], component: Sequence[int]) -> list[int]:
    """Return the tier of each node."""
    below = condense(needs, component)
    tier = [0] * len(below)
    for number, targets in enumerate(below):
        tier[number] = 1 + max((tier[target] for target in targets), default=-1)
    return [tier[number] for number in component]


def reduce_edges(needs: Sequence[Sequence[int]], component: Sequence[int]) -> list[Edge]:
    """Return the edges that no longer path implies (transitive reduction); those inside a cycle all stay."""
    below = condense(needs, component)
    reach = [0] * len(below)
    kept: set[Edge] = set()
    for number, targets in enumerate(below):
        reached = 0
        # The highest numbers stand latest in the topological order, so they can only be reached, not reach.
        for target in sorted(targets, reverse=True):
            if not reached >> target & 1:
                kept.add((number, target))
                reached |= reach[target] | 1 << target
        reach[number] = reached
    return [
        (node, target)
        for node, targets in enumerate(needs)
        for target in targets
        if component[node] == component[target] or (component[node], component[target]) in kept
    ]
