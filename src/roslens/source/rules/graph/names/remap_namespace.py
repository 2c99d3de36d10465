"""Rule ``graph.remap_namespace``: a remapping to a global name of a node that a namespace has moved."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredRemap
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.remap_namespace",
    "Remapping out of the namespace",
    "A node in a namespace is given a global name by a remapping (`/camera/image`), and what the name is below, a node "
    "or a namespace `camera`, is in the namespace too and nowhere else: nothing has the global name. Leave the leading "
    "`/` out. Nothing is reported where another node has the name, or is remapped to it as well.",
    Consequence.WRONG,
    Certainty.LIKELY,
    ("ros", "graph", "names", "launch"),
    "A namespace moves relative names only: the node waits for a topic that nobody publishes, and nothing says so.",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each remapping whose target is global and below what is in the namespace of the node."""
    names = {node.name for node in configuration.nodes}
    for node in configuration.nodes:
        for one in node.remaps:
            holder = _holder(node, one, names)
            if holder and not surroundings.is_external(one.target) and not _is_met(node, one, configuration):
                yield _told(node, one, holder)


def _holder(node: ConfiguredNode, one: ConfiguredRemap, names: set[str]) -> str:
    """Return what has the first part of a global name within the namespace of a node alone; empty for nothing."""
    space = node.name.rpartition("/")[0]
    first, _, rest = one.target.lstrip("/").partition("/")
    if not space or not rest or not one.target.startswith("/") or "*" in one.target or "{" in one.target:
        return ""
    inside = sorted(name for name in names if _is_below(name, f"{space}/{first}"))
    if not inside or any(_is_below(name, f"/{first}") for name in names):
        return ""
    return inside[0]


def _is_below(name: str, space: str) -> bool:
    return name == space or name.startswith(f"{space}/")


def _is_met(node: ConfiguredNode, one: ConfiguredRemap, configuration: Configuration) -> bool:
    """Return whether another node has the name, is remapped to it, or may have any."""
    for other in configuration.nodes:
        if other.name == node.name:
            continue
        if not other.resolved or any(each.target == one.target for each in other.remaps):
            return True
        if any(each.endpoint.name == one.target for each in other.endpoints):
            return True
    return False


def _told(node: ConfiguredNode, one: ConfiguredRemap, holder: str) -> Finding:
    certainty, doubt = weighed(RULE.certainty, (one.proof,), node.conditions)
    space = node.name.rpartition("/")[0]
    message = (
        f"remapping of `{one.source}` to `{one.target}`: {node.name} is in the namespace {space}, and so is {holder}, "
        f"whose names are below {space}. Nothing has the global name. Write `{one.target.lstrip('/')}`."
    )
    context = f"{one.source}:={one.target}"
    return occurrence(
        RULE, message, one.proof, entity=f"node:{node.name}", certainty=certainty, context=context, doubt=doubt
    )
