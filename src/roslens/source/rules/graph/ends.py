"""The ends of topics, services and actions that a configuration has, by name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roslens.model.configuration import Configuration, ConfiguredNode, Origin, Unresolved
from roslens.model.graphs.end import KIND, End
from roslens.source.rules.graph.doubt import doubt_of, exclude_each_other


def order_of(end: End) -> tuple[int, str, str, str]:
    """Return a key that sorts the clearest end first, then by node and place."""
    return doubt_of([end.one.proof], end.conditions), end.node.name, end.one.proof.place, end.name


def conditions_of(first: End, second: End) -> tuple[str, ...]:
    """Return what must hold for both ends to be there.

    What one word means in the code of two nodes are two values, of each its own: whose it is, is stated.
    """
    if first.node.name == second.node.name:
        return (*first.conditions, *second.conditions)
    shared = {one.text for one in first.one.clauses} & {one.text for one in second.one.clauses}
    return (*_of(first, shared), *_of(second, shared))


def exclude(first: End, second: End) -> bool:
    """Return whether two ends of one node are there under opposite conditions."""
    same = (first.node.name, first.node.proof.place) == (second.node.name, second.node.proof.place)
    return same and exclude_each_other(first.clauses, second.clauses)


def _of(end: End, shared: set[str]) -> Iterator[str]:
    yield from end.node.conditions
    for words, one in zip(end.one.conditions, end.one.clauses, strict=True):
        # What the preprocessor decides is the same for all that is built together.
        own = one.text in shared and "#" not in one.text
        yield f"{words} in {end.node.name}" if own else words


def ends(configuration: Configuration) -> list[End]:
    """Return all ends of which the whole name is known, without those that every node has."""
    return [
        End(node, one)
        for node in configuration.nodes
        if node.resolved
        for one in node.endpoints
        if one.resolved and not one.implicit
    ]


def unresolved_ends(configuration: Configuration) -> list[End]:
    """Return the ends of which a part of the name is unknown."""
    return [
        End(node, one)
        for node in configuration.nodes
        for one in node.endpoints
        if not (one.resolved and node.resolved) and not one.implicit
    ]


def by_name(all_ends: Sequence[End]) -> dict[tuple[str, str], list[End]]:
    """Return ends by kind and name, both sorted; the clearest end of each first."""
    found: dict[tuple[str, str], list[End]] = {}
    for end in sorted(all_ends, key=order_of):
        found.setdefault((KIND[end.role], end.name), []).append(end)
    return dict(sorted(found.items()))


def unknown_nodes(configuration: Configuration) -> list[ConfiguredNode]:
    """Return the nodes of which nobody knows what they make."""
    return sorted((node for node in configuration.nodes if is_unknown(node)), key=lambda node: (node.name, node.proof))


def missing_parts(configuration: Configuration) -> list[Unresolved]:
    """Return what may start further nodes and could not be followed: the configuration is not whole."""
    return [one for one in configuration.unresolved if one.opens]


def is_unknown(node: ConfiguredNode) -> bool:
    """Return whether the code of a node is not there, or was not understood: no node uses nothing of ROS."""
    if node.defined is None:
        return True
    if node.defined.origin is not Origin.CODE:
        return False
    says = any(not one.implicit and one.proof.line for one in node.endpoints) or bool(node.timers)
    return not says and not any(one.access for one in node.parameters)


def is_launched(configuration: Configuration) -> bool:
    """Return whether launch files say what runs together; else nodes stand alone."""
    return any(node.proof.origin is Origin.LAUNCH for node in configuration.nodes)


def listed(words: Sequence[str], most: int = 3) -> str:
    """Return a list in words, cut after ``most``."""
    shown = list(dict.fromkeys(words))
    rest = len(shown) - most
    return ", ".join(shown[:most]) + (f" and {rest} more" if rest > 0 else "")
