"""What source says: the configuration that is looked at, and what else of the workspace could make an entity."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode
from roslens.model.finding import Finding
from roslens.model.graph import Role

KIND = {
    Role.PUBLISHER: "topic", Role.SUBSCRIPTION: "topic",
    Role.SERVICE_SERVER: "service", Role.SERVICE_CLIENT: "service",
    Role.ACTION_SERVER: "action", Role.ACTION_CLIENT: "action",
}  # fmt: skip
MAKERS = {"topic": Role.PUBLISHER, "service": Role.SERVICE_SERVER, "action": Role.ACTION_SERVER}
"""Who makes what arrives, by kind of entity."""
VERB = {
    Role.PUBLISHER: "publishes", Role.SUBSCRIPTION: "subscribes to",
    Role.SERVICE_SERVER: "serves", Role.SERVICE_CLIENT: "calls",
    Role.ACTION_SERVER: "serves", Role.ACTION_CLIENT: "calls",
}  # fmt: skip


class End(msgspec.Struct, frozen=True):
    """An endpoint and its node."""

    node: ConfiguredNode
    one: ConfiguredEndpoint

    @property
    def name(self) -> str:
        """Resolved name."""
        return self.one.endpoint.name

    @property
    def role(self) -> Role:
        """What it does."""
        return self.one.endpoint.role

    @property
    def conditions(self) -> tuple[str, ...]:
        """What must hold for it to be there."""
        return (*self.node.conditions, *self.one.conditions)

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


class Elsewhere(msgspec.Struct, frozen=True):
    """What the workspace has besides, and how it comes to run, as in ``rover.launch.py sim:=true starts it``.

    ``command`` shows or starts it. ``loose`` is code that no known program starts: in what node, is not known.
    """

    how: str
    configuration: Configuration
    command: str = ""
    loose: bool = False


class Declared(msgspec.Struct, frozen=True):
    """What source says.

    Attributes:
        title: of the configuration: a launch file with its arguments, or the packages.
        configuration: that is looked at.
        elsewhere: what else could start or make an entity, the likeliest first.
        findings: of the rules on this configuration.
        launched: whether a launch file says what runs together.
        command: that shows the configuration.
    """

    title: str
    configuration: Configuration
    elsewhere: tuple[Elsewhere, ...] = ()
    findings: tuple[Finding, ...] = ()
    launched: bool = True
    command: str = ""


def ends_of(configuration: Configuration, *, implicit: bool = False) -> Iterator[End]:
    """Yield the ends whose names are known whole."""
    for node in configuration.nodes:
        for one in node.endpoints:
            if one.resolved and node.resolved and (implicit or not one.implicit):
                yield End(node, one)


def ends_named(configuration: Configuration, kind: str, name: str) -> list[End]:
    """Return the ends of a topic, service or action."""
    return [one for one in ends_of(configuration, implicit=True) if one.name == name and KIND[one.role] == kind]


def open_ends(configuration: Configuration, kind: str, name: str) -> list[End]:
    """Return the ends of which only a part of the name is known, which may be this one."""
    from fnmatch import fnmatchcase

    return [
        End(node, one)
        for node in configuration.nodes
        for one in node.endpoints
        if not (one.resolved and node.resolved)
        and KIND[one.endpoint.role] == kind
        and set(one.endpoint.name) > {"/", "*"}
        and fnmatchcase(name, one.endpoint.name)
    ]


def unread_nodes(configuration: Configuration) -> list[ConfiguredNode]:
    """Return the nodes whose code is not in the workspace and that no catalogue knows: what they make is unknown."""
    return [
        one for one in configuration.nodes
        if one.defined is None and all(end.implicit for end in one.endpoints) and one.kind != "process"
    ]  # fmt: skip


def known_names(declared: Declared) -> dict[str, set[str]]:
    """Return all names of the configuration and of what is elsewhere, by kind."""
    found: dict[str, set[str]] = {"topic": set(), "service": set(), "action": set(), "node": set()}
    for one in (declared.configuration, *(other.configuration for other in declared.elsewhere)):
        for end in ends_of(one, implicit=True):
            found[KIND[end.role]].add(end.name)
        found["node"] |= {node.name for node in one.nodes if node.resolved}
    return found
