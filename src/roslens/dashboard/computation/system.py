"""A configuration as elements and wires: nodes, topics, services, actions, and which way things flow between them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from enum import Enum

import msgspec

from roslens.dashboard.computation.noise import IMPLICIT, kinds_of_noise
from roslens.dashboard.plan.mark import lane_of, namespace_of
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode
from roslens.model.finding import Finding
from roslens.model.graph import Role

_UNSAFE = re.compile(r"[^A-Za-z0-9._+-]+")
_SURENESS = ("certain", "likely", "possible")


class Kind(str, Enum):
    """What an element is."""

    NODE = "node"
    TOPIC = "topic"
    SERVICE = "service"
    ACTION = "action"


KIND_OF_ROLE = {
    Role.PUBLISHER: Kind.TOPIC,
    Role.SUBSCRIPTION: Kind.TOPIC,
    Role.SERVICE_SERVER: Kind.SERVICE,
    Role.SERVICE_CLIENT: Kind.SERVICE,
    Role.ACTION_SERVER: Kind.ACTION,
    Role.ACTION_CLIENT: Kind.ACTION,
}
OUTWARD = frozenset({Role.PUBLISHER, Role.SERVICE_CLIENT, Role.ACTION_CLIENT})
"""Roles from which things flow to the topic, service or action: messages and requests."""


class Element(msgspec.Struct, frozen=True):
    """A node, topic, service or action.

    Attributes:
        key: names its page, unique within the configuration.
        lane: the namespace in whose box it stands.
        sure: the least sure of what shows it.
        noise: presets that leave it out.
        severity: of the worst finding about it; empty without any.
        program: of a node of whose own name nothing is known, what it runs.
    """

    kind: Kind
    name: str
    key: str
    lane: str
    sure: str = "certain"
    conditional: bool = False
    resolved: bool = True
    noise: tuple[str, ...] = ()
    severity: str = ""
    program: str = ""


class Wire(msgspec.Struct, frozen=True):
    """Things flow from element ``source`` to element ``target``; ``endpoints`` are numbers into the system's ends."""

    source: int
    target: int
    endpoints: tuple[int, ...]
    conditional: bool = False
    resolved: bool = True
    implicit: bool = False
    sure: str = "certain"


class End(msgspec.Struct, frozen=True):
    """An endpoint, its node and the element that it joins the node to."""

    node: int
    channel: int
    configured: ConfiguredEndpoint


class System:
    """One configuration with its elements and wires, nodes first, each sorted as the configuration has them."""

    def __init__(self, slug: str, configuration: Configuration, findings: Sequence[Finding] = ()) -> None:
        """Work out elements and wires.

        Args:
            slug: names its pages.
            configuration: what would run.
            findings: about it; those that name one of its nodes, topics, services or actions are shown there.
        """
        self.slug = slug
        self.configuration = configuration
        self.findings = tuple(findings)
        self._about: dict[str, list[Finding]] = {}
        for finding in findings:
            for owner in _owners(finding):
                self._about.setdefault(owner, []).append(finding)
        self.nodes = configuration.nodes
        self._lanes = {namespace_of(node.name) for node in self.nodes}
        self.elements: list[Element] = []
        self.ends: list[End] = []
        self._add_nodes()
        self._add_channels()
        self.by_key = {element.key: number for number, element in enumerate(self.elements)}
        self._numbers: dict[str, list[int]] = {}
        for number, element in enumerate(self.elements):
            self._numbers.setdefault(f"{element.kind.value}:{element.name}", []).append(number)
        self.wires = self._wires()

    def findings_on(self, element: Element) -> tuple[Finding, ...]:
        """Return what is wrong with an element."""
        return tuple(self._about.get(f"{element.kind.value}:{element.name}", ()))

    def elements_of(self, finding: Finding) -> tuple[int, ...]:
        """Return the numbers of the elements that a finding is about."""
        return tuple(number for owner in _owners(finding) for number in self._numbers.get(owner, ()))

    def ends_of(self, number: int) -> list[End]:
        """Return the endpoints of a node or at a topic, service or action."""
        return [end for end in self.ends if number in {end.node, end.channel}]

    def _add_nodes(self) -> None:
        taken: dict[str, int] = {}
        for node in self.nodes:
            taken[node.name] = taken.get(node.name, 0) + 1
            key = node.name if taken[node.name] == 1 else f"{node.name}~{taken[node.name]}"
            element = Element(
                Kind.NODE,
                node.name,
                f"node/{key.strip('/')}",
                namespace_of(node.name),
                sure=node.proof.sure,
                conditional=bool(node.conditions),
                resolved=node.resolved,
                program=node.executable.rpartition("::")[2] if node.name.endswith("/*") else "",
            )
            self.elements.append(msgspec.structs.replace(element, severity=self._severity(element)))

    def _add_channels(self) -> None:
        found: dict[tuple[str, str, int], list[tuple[int, ConfiguredEndpoint]]] = {}
        for number, node in enumerate(self.nodes):
            for one in node.endpoints:
                word = KIND_OF_ROLE[one.endpoint.role].value
                # Names that are not known in full may be any; two nodes are not joined by both being unknown.
                owner = -1 if one.resolved else number
                found.setdefault((one.endpoint.name, word, owner), []).append((number, one))
        taken: dict[str, int] = {}
        for (name, word, _), users in sorted(found.items(), key=lambda item: item[0]):
            kind = Kind(word)
            key = f"{word}/{name.strip('/')}"
            taken[key] = taken.get(key, 0) + 1
            noise = kinds_of_noise(name)
            if all(one.implicit for _, one in users):
                noise = (IMPLICIT, *noise)
            element = Element(
                kind,
                name,
                key if taken[key] == 1 else f"{key}~{taken[key]}",
                lane_of(name, self._lanes),
                sure=_least_sure([one for _, one in users]),
                conditional=all(one.conditions or self.nodes[node].conditions for node, one in users),
                resolved=any(one.resolved for _, one in users),
                noise=noise,
            )
            channel = len(self.elements)
            self.elements.append(msgspec.structs.replace(element, severity=self._severity(element)))
            self.ends += [End(node, channel, one) for node, one in users]

    def _severity(self, element: Element) -> str:
        found = [finding.severity for finding in self.findings_on(element)]
        return max(found, key=lambda severity: severity.rank).value if found else ""

    def _wires(self) -> tuple[Wire, ...]:
        found: dict[tuple[int, int], list[tuple[int, ConfiguredEndpoint]]] = {}
        for number, end in enumerate(self.ends):
            out = end.configured.endpoint.role in OUTWARD
            pair = (end.node, end.channel) if out else (end.channel, end.node)
            found.setdefault(pair, []).append((number, end.configured))
        return tuple(
            Wire(
                source,
                target,
                tuple(number for number, _ in ends),
                conditional=all(one.conditions for _, one in ends),
                resolved=any(one.resolved for _, one in ends),
                implicit=all(one.implicit for _, one in ends),
                sure=_least_sure([one for _, one in ends]),
            )
            for (source, target), ends in sorted(found.items())
        )


def _owners(finding: Finding) -> tuple[str, ...]:
    return tuple(dict.fromkeys(map(_owner, (finding.entity, *finding.also))))


def _owner(entity: str) -> str:
    """Return the element on which something about an entity is shown: of a parameter its node."""
    kind, _, rest = entity.partition(":")
    return f"node:{rest.partition(':')[0]}" if kind == "parameter" else entity


def _least_sure(endpoints: Sequence[ConfiguredEndpoint]) -> str:
    ranks = [_SURENESS.index(one.proof.sure) if one.proof.sure in _SURENESS else 2 for one in endpoints]
    return _SURENESS[max(ranks, default=0)]


def systems_of(
    configurations: Mapping[str, Configuration], findings: Mapping[str, Sequence[Finding]] | None = None
) -> dict[str, System]:
    """Return a system for each configuration by its slug, in the given order.

    Args:
        configurations: by the names that the caller gives them.
        findings: about each, by the same names.
    """
    found: dict[str, System] = {}
    for name, configuration in configurations.items():
        slug = start = _UNSAFE.sub("-", name).strip("-") or "system"
        number = 1
        while slug in found:
            number += 1
            slug = f"{start}-{number}"
        found[slug] = System(slug, configuration, (findings or {}).get(name, ()))
    return found


def node_of(system: System, number: int) -> ConfiguredNode | None:
    """Return the configured node behind an element; None for a topic, service or action."""
    return system.nodes[number] if number < len(system.nodes) else None
