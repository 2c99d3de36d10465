"""Code that makes endpoints and that no known program starts: libraries, plug-ins, scripts that no build installs.

What a workspace's units make is shown once by the nodes that programs become. What is left is grouped by its unit, each
with its endpoints: in which node they will be is not known, so that none of them is certain.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import msgspec

from roslens.model.configuration import Configuration, ConfiguredNode, Unresolved
from roslens.model.unstarted import REASONS
from roslens.source.extract.configuration.assemble import with_checksums
from roslens.source.extract.configuration.assemble_arguments import CommandLine
from roslens.source.extract.configuration.assemble_node import Given, assembled
from roslens.source.extract.configuration.assemble_units import Units
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.facts.meant import Meant
from roslens.source.extract.facts.node_facts import Evidence, NodeFacts, Target, TargetKind
from roslens.source.extract.symbolic.reason import NamePart, OfNode
from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.symbols.call_sites import places_of
from roslens.source.settings import NodeHint

TITLE = "created by libraries, plug-ins and scripts that no known program starts"
_LOADED = frozenset({TargetKind.PLUGIN, TargetKind.COMPONENT, TargetKind.NODELET})
_ORDER = {"program": 0, "script": 0, "plugin": 1, "library": 2}
_ALONE = ("function", "part")
_UNKNOWN_NAME = str(OfNode(NamePart.NAME))
"""What a name depends on of which no more is known than that of any node that nothing starts."""


class Unstarted(msgspec.Struct, frozen=True):
    """A unit that nothing starts: its facts, its package, what it is, and what describes it (the XML of a plug-in)."""

    facts: NodeFacts
    package: str
    kind: str
    target: Target | None = None


def unstarted(
    facts: Iterable[NodeFacts],
    shown: set[tuple[str, int]],
    packages: Mapping[str, str],
    targets: Iterable[Target],
) -> list[Unstarted]:
    """Return the units that make endpoints which are shown nowhere else, in order of their packages and files.

    Args:
        facts: of all units of a workspace.
        shown: where endpoints are made that are shown: path and line.
        packages: name of the package of each file.
        targets: what builds make: they say under which name a plug-in is loaded.
    """
    loaded = {(one.entry or one.name).replace("::", "."): one for one in targets if one.kind in _LOADED}
    found = [
        Unstarted(one, packages.get(one.path, ""), _kind(one, loaded), loaded.get(one.unit))
        for one in facts
        if one.endpoints
    ]
    # A program has more information than a class that it creates, and a class more than a function.
    found.sort(key=lambda one: (_ORDER[one.kind], one.facts.kind in _ALONE, one.facts.path, one.facts.line))
    covered = set(shown)
    kept = []
    for one in found:
        places = set(places_of(one.facts))
        if not {(end.evidence.path, end.evidence.line) for end in one.facts.endpoints} <= covered:
            kept.append(one)
            covered |= places
    return sorted(kept, key=lambda one: (one.package, one.facts.path, one.facts.line, one.facts.unit))


def _kind(facts: NodeFacts, loaded: Mapping[str, Target]) -> str:
    if facts.unit == "main":
        return "program"
    if facts.path.endswith(".py") or "." not in facts.path.rpartition("/")[2]:
        return "script" if facts.unit == "<module>" else "library"
    return "plugin" if facts.unit in loaded else "library"


def places_shown(configurations: Iterable[Configuration]) -> set[tuple[str, int]]:
    """Return where the endpoints of configurations are made, helpers that pass names on included: path and line."""
    return {(end.proof.path, end.proof.line) for one in configurations for node in one.nodes for end in node.endpoints}


def unstarted_configuration(
    generation: str,
    found: Sequence[Unstarted],
    units: Units,
    *,
    hints: Mapping[str, NodeHint],
    hinted_in: str,
    roles: Mapping[str, str],
    missed: Sequence[Unresolved] = (),
) -> Configuration:
    """Return what units come to that nothing starts.

    Args:
        generation: ``ros1`` or ``ros2``.
        found: units of it.
        units: of the workspace, which knows checksums of types.
        hints: of the user.
        hinted_in: the file that has the hints.
        roles: whose code a file is where it is not own code.
        missed: what else was not understood.
    """
    nodes: list[ConfiguredNode] = []
    unresolved: list[Unresolved] = list(missed)
    for one in found:
        node, missing = assembled(_given(one, generation, hints, hinted_in), _doubted(one), Meant((one.facts,)))
        ends = tuple(end for end in node.endpoints if not end.implicit)
        role = roles.get(one.facts.path, "")
        nodes.append(with_checksums(msgspec.structs.replace(node, endpoints=ends, role=role), units))
        unresolved += [msgspec.structs.replace(two, role=role) for two in missing if two.cause != _UNKNOWN_NAME]
    return Configuration(
        TITLE,
        generation,
        tuple(nodes),
        unresolved=tuple(
            sorted(dict.fromkeys(unresolved), key=lambda one: (one.role, one.proof, one.node, one.text, one.reason))
        ),
        unstarted=True,
    )


def _given(one: Unstarted, generation: str, hints: Mapping[str, NodeHint], hinted_in: str) -> Given:
    facts, target = one.facts, one.target
    name = target.name if target is not None else facts.path.rpartition("/")[2]
    launched = Launched(
        package=Text.of(one.package),
        executable=Text() if target is not None else Text.of(name),
        evidence=Evidence(facts.path, facts.line) if target is None else target.evidence,
        plugin=Text() if target is None else Text.of(name),
        kind=one.kind,
    )
    return Given(launched, CommandLine(), generation, by_launch=False, hints=dict(hints), hinted_in=hinted_in)


def _doubted(one: Unstarted) -> NodeFacts:
    reasons = (one.facts.doubt, f"of {REASONS[one.kind]}")
    return msgspec.structs.replace(one.facts, doubt="; ".join(filter(None, reasons)))
