"""An end of a topic, service or action: an endpoint of a configuration together with its node."""

from __future__ import annotations

import msgspec

from roslens.model.configuration import Clause, ConfiguredEndpoint, ConfiguredNode, Origin, Proof
from roslens.model.graph import Role

KIND = {
    Role.PUBLISHER: "topic",
    Role.SUBSCRIPTION: "topic",
    Role.SERVICE_SERVER: "service",
    Role.SERVICE_CLIENT: "service",
    Role.ACTION_SERVER: "action",
    Role.ACTION_CLIENT: "action",
}
VERB = {
    Role.PUBLISHER: "publishes",
    Role.SUBSCRIPTION: "subscribes to",
    Role.SERVICE_SERVER: "serves",
    Role.SERVICE_CLIENT: "calls",
    Role.ACTION_SERVER: "serves",
    Role.ACTION_CLIENT: "calls",
}
_OF_SEVERAL = {"publishes": "publish", "subscribes to": "subscribe to", "serves": "serve", "calls": "call"}
OTHER = {
    Role.PUBLISHER: Role.SUBSCRIPTION,
    Role.SUBSCRIPTION: Role.PUBLISHER,
    Role.SERVICE_SERVER: Role.SERVICE_CLIENT,
    Role.SERVICE_CLIENT: Role.SERVICE_SERVER,
    Role.ACTION_SERVER: Role.ACTION_CLIENT,
    Role.ACTION_CLIENT: Role.ACTION_SERVER,
}


def verb_of(role: Role, count: int = 1) -> str:
    """Return what one node does with an end of a role, or several do."""
    return VERB[role] if count == 1 else _OF_SEVERAL[VERB[role]]


Key = tuple[str, str, str, str, str]


class End(msgspec.Struct, frozen=True):
    """An endpoint and its node."""

    node: ConfiguredNode
    one: ConfiguredEndpoint

    @property
    def name(self) -> str:
        """Resolved name of the topic, service or action."""
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
    def own_name(self) -> str:
        """The name that it had without remappings."""
        given = self.one.given or self.name
        if given.startswith("/"):
            return given
        if given.startswith("~"):
            return f"{self.node.name}/{given[1:].lstrip('/')}"
        return f"{self.node.name.rpartition('/')[0]}/{given}"

    @property
    def line(self) -> str:
        """The end in words, with the places of its code, its start and its remapping."""
        started = self.node.proof.place
        words = f"{self.node.name} {VERB[self.role]} {self.name}: {self.one.proof.place or self.one.proof.how}"
        if started and started != self.one.proof.place:
            words += f", started at {started}"
        if self.one.remapped is not None and self.own_name != self.name:
            words += f", remapped from {self.own_name} at {self.one.remapped.place}"
        if self.conditions:
            words += f", only if {' and '.join(f'`{one}`' for one in self.conditions)}"
        return words
