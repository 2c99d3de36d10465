"""The ends of topics, services and actions that a configuration has, by name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from roslens.model.configuration import (
    Clause,
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    Origin,
    Proof,
    Unresolved,
)
from roslens.model.graph import Role
from roslens.source.rules.graph.doubt import doubt_of, exclude_each_other

KIND = {
    Role.PUBLISHER: "topic",
    Role.SUBSCRIPTION: "topic",
    Role.SERVICE_SERVER: "service",
    Role.SERVICE_CLIENT: "service",
    Role.ACTION_SERVER: "action",
    Role.ACTION_CLIENT: "action",
}
WORDS = {
    Role.PUBLISHER: "publishes",
    Role.SUBSCRIPTION: "subscribes to",
    Role.SERVICE_SERVER: "serves",
    Role.SERVICE_CLIENT: "calls",
    Role.ACTION_SERVER: "serves",
    Role.ACTION_CLIENT: "calls",
}
OTHER = {
    Role.PUBLISHER: Role.SUBSCRIPTION,
    Role.SUBSCRIPTION: Role.PUBLISHER,
    Role.SERVICE_SERVER: Role.SERVICE_CLIENT,
    Role.SERVICE_CLIENT: Role.SERVICE_SERVER,
    Role.ACTION_SERVER: Role.ACTION_CLIENT,
    Role.ACTION_CLIENT: Role.ACTION_SERVER,
}


Key = tuple[str, str, str, str, str]


class End(msgspec.Struct, frozen=True):
    """An endpoint and its node."""

    node: ConfiguredNode
    one: ConfiguredEndpoint

    @property
    def name(self) -> str:
        """Name of the topic, service or action."""
        return self.one.endpoint.name

    @property
    def role(self) -> Role:
        """What it does."""
        return self.one.endpoint.role

    @property
    def type(self) -> str:
        """Of the interface; empty where unknown."""
        return self.one.endpoint.type

    @property
    def conditions(self) -> tuple[str, ...]:
        """What must hold for it to be there."""
        return (*self.node.conditions, *self.one.conditions)

    @property
    def clauses(self) -> tuple[Clause, ...]:
        """What must hold, and what must not, for it to be there."""
        return (*self.node.clauses, *self.one.clauses)

    @property
    def entity(self) -> str:
        """Id of the topic, service or action."""
        return f"{KIND[self.role]}:{self.name}"

    @property
    def key(self) -> Key:
        """What tells it from other ends."""
        return self.node.name, self.node.proof.place, self.role.value, self.name, self.one.proof.place

    @property
    def where(self) -> Proof:
        """What shows it in the workspace: for what is known of an installed node, the place that starts the node."""
        is_installed = self.one.proof.origin is Origin.CATALOGUE and self.node.proof.path
        return self.node.proof if is_installed else self.one.proof

    @property
    def label(self) -> str:
        """The node and the place, as messages name it."""
        place = self.where.place
        return f"{self.node.name} ({place})" if place else self.node.name

    @property
    def order(self) -> tuple[int, str, str, str]:
        """The clearest first, then by node and place."""
        return doubt_of([self.one.proof], self.conditions), self.node.name, self.one.proof.place, self.name


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
    for end in sorted(all_ends, key=lambda one: one.order):
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
