"""Rule ``graph.parameter_namespace``: a parameter that is set in another namespace than it is read in (ROS 1)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set

import msgspec

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import listed, unknown_nodes
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.parameter_namespace",
    "Parameter in another namespace",
    "A launch file of ROS 1 sets a private parameter of a node (`~x`, as `<param>` within `<node>` does) whose code "
    "reads that name globally or in the namespace of the node, where it is not set; or it sets the name there, where "
    "no node reads it, and the code reads `~x`, which is not set. Move the `<param>` into the node or out of it, or "
    "read the other name.",
    Consequence.WRONG,
    Certainty.LIKELY,
    ("ros", "graph", "parameters", "names", "launch"),
    "The value is ignored silently, and the node runs with its default.",
)


class Misplaced(msgspec.Struct, frozen=True):
    """A parameter that is set under one name and read under another one.

    Attributes:
        node: whose code reads it.
        set: as it is set.
        read: as it is read.
        private: whether it is set for the node alone, and read elsewhere.
    """

    node: ConfiguredNode
    set: ConfiguredParameter
    read: ConfiguredParameter
    private: bool


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each parameter that is set where its node does not look for it."""
    unknown = [node.name for node in unknown_nodes(configuration)]
    for one in misplaced(configuration):
        yield _told(one, unknown)


def misplaced(configuration: Configuration) -> Iterator[Misplaced]:
    """Yield the parameters of a configuration that are set in another namespace than they are read in."""
    if configuration.generation != "ros1":
        return
    names = _Names.of(configuration)
    for node in configuration.nodes:
        if node.resolved and node.defined is not None:
            known = {one.name: one for one in node.parameters if one.access == "read" and one.proof is not None}
            yield from _set_privately(node, known, names)
            yield from _read_privately(node, known, names)


class _Names(msgspec.Struct, frozen=True):
    """Names of parameters of a configuration.

    Attributes:
        read: by any node.
        shared: set for no node in particular.
        values: set at all.
    """

    read: frozenset[str]
    shared: Mapping[str, ConfiguredParameter]
    values: frozenset[str]

    @classmethod
    def of(cls, configuration: Configuration) -> _Names:
        parameters = [one for node in configuration.nodes for one in node.parameters]
        shared = {one.name: one for one in configuration.parameters if one.set_by is not None}
        values = {one.name for one in parameters if one.set_by is not None}
        return cls(frozenset(one.name for one in parameters if one.access), shared, frozenset(values | shared.keys()))


def _set_privately(
    node: ConfiguredNode, known: Mapping[str, ConfiguredParameter], names: _Names
) -> Iterator[Misplaced]:
    """Yield what is set in the namespace of a node, and read by it in one around it."""
    prefix = f"{node.name}/"
    for one in node.parameters:
        if one.set_by is None or not one.name.startswith(prefix) or _is_read(one.name, names.read):
            continue
        elsewhere = [name for name in _outside(one.name.removeprefix(prefix), node) if name in known]
        if elsewhere and not any(_is_set(name, names.values) for name in elsewhere):
            yield Misplaced(node, one, known[elsewhere[0]], private=True)


def _read_privately(
    node: ConfiguredNode, known: Mapping[str, ConfiguredParameter], names: _Names
) -> Iterator[Misplaced]:
    """Yield what a node reads in its namespace, and is set in one around it."""
    prefix = f"{node.name}/"
    for name, one in known.items():
        if not name.startswith(prefix) or "*" in name or _is_set(name, names.values):
            continue
        places = [other for other in _outside(name.removeprefix(prefix), node) if other in names.shared]
        if places and not any(_is_read(other, names.read) for other in places):
            yield Misplaced(node, names.shared[places[0]], one, private=False)


def _outside(name: str, node: ConfiguredNode) -> Iterator[str]:
    """Yield a name in the namespaces around a node, the innermost first."""
    space = node.name.rpartition("/")[0]
    while space:
        yield f"{space}/{name}"
        space = space.rpartition("/")[0]
    yield f"/{name}"


def _is_read(name: str, read: Set[str]) -> bool:
    """Whether somebody reads a name, or a map that it is in."""
    return name in read or any(name.startswith(one.rstrip("/") + "/") for one in read)


def _is_set(name: str, values: Set[str]) -> bool:
    """Whether a name is set, or something below it."""
    return name in values or any(one.startswith(f"{name}/") for one in values)


def _told(one: Misplaced, unknown: list[str]) -> Finding:
    proof, code = one.set.set_by, one.read.proof
    assert proof is not None  # noqa: S101 - only parameters that are set are misplaced
    assert code is not None  # noqa: S101 - and that code reads
    node = one.node.name
    more = f"the parameters that {listed(unknown)} read are unknown" if unknown and not one.private else ""
    certainty, doubt = weighed(RULE.certainty, (proof, code), one.node.conditions, more=more)
    private = f"~{(one.set if one.private else one.read).name.removeprefix(f'{node}/')}"
    advice = (
        f"Set it outside of the node, or read `{private}`"
        if one.private
        else f"Set it within the node, or read `{one.set.name}`"
    )
    message = (
        f"parameter `{one.set.name}` is set ({proof.place}), but {node} ({code.place}) reads `{one.read.name}`, which "
        f"is not set: the value has no effect. {advice}."
    )
    entity = f"parameter:{node}:{one.set.name}"
    return occurrence(RULE, message, proof, entity=entity, certainty=certainty, context=one.read.name, doubt=doubt)
