"""Rule ``graph.remap``: a remapping that matches nothing."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredRemap
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import is_unknown, listed
from roslens.source.rules.graph.likeness import nearest_name
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.told import TOOL, told

RULE = RuleInfo(
    "graph.remap",
    "Remapping that matches nothing",
    "A remapping names what none of the nodes that it holds for uses. Nodes whose code is unknown, or not understood "
    "everywhere, are taken to use it. Correct the name, or remove the remapping.",
    Severity.WARNING,
    ("ros", "graph", "names", "launch"),
    "The node keeps its name and the one meant stays unconnected; nothing says that a remapping had no effect.",
    tool=TOOL,
    scope="configuration",
)


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each remapping that has no effect on any node."""
    held: dict[ConfiguredRemap, list[ConfiguredNode]] = {}
    effective: set[tuple[str, str, str]] = set()
    for node in configuration.nodes:
        for one in node.remaps:
            if one.used or one.uncertain or one.source == one.target or is_unknown(node):
                effective.add(_key(one))
            else:
                held.setdefault(one, []).append(node)
    for one, nodes in sorted(held.items(), key=lambda item: item[0]):
        if _key(one) not in effective:
            yield _told(one, nodes)


def _key(one: ConfiguredRemap) -> tuple[str, str, str]:
    return one.proof.place, one.source, one.target


def _told(one: ConfiguredRemap, nodes: list[ConfiguredNode]) -> Finding:
    names = [end.given or end.endpoint.name for node in nodes for end in node.endpoints if not end.implicit]
    names += [end.endpoint.name for node in nodes for end in node.endpoints if not end.implicit]
    near = nearest_name(one.source, names)
    advice = f"Did you mean `{near}`?" if near else "Correct the name or remove the remapping."
    severity, doubt = weighed(RULE.severity, (one.proof,), nodes[0].conditions)
    who = listed([node.name for node in nodes])
    verb = "uses" if len(nodes) == 1 else "use"
    message = f"remapping of `{one.source}` to `{one.target}`: {who} {verb} no such name. {advice}{doubt}"
    context = f"{one.source}:={one.target}"
    return told(RULE, message, one.proof, entity=f"node:{nodes[0].name}", severity=severity, context=context)
