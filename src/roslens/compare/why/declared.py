"""What source says: the configuration that is looked at, and what else of the workspace could make an entity."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.configuration import Configuration, ConfiguredNode
from roslens.model.finding import Finding
from roslens.model.graph import Role
from roslens.model.graphs.end import KIND, End

MAKERS = {"topic": Role.PUBLISHER, "service": Role.SERVICE_SERVER, "action": Role.ACTION_SERVER}
"""Who makes what arrives, by kind of entity."""


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
        failures: launch files that could not be looked at, a sentence each.
    """

    title: str
    configuration: Configuration
    elsewhere: tuple[Elsewhere, ...] = ()
    findings: tuple[Finding, ...] = ()
    launched: bool = True
    command: str = ""
    failures: tuple[str, ...] = ()


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
