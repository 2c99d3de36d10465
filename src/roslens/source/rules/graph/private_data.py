"""Rule ``graph.private_data``: a topic that only one node uses, with a name that all share."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, Origin
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import End, by_name, ends, is_launched, unknown_nodes
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.told import TOOL, told

RULE = RuleInfo(
    "graph.private_data",
    "Private data on a shared name",
    "A node publishes a topic that only itself subscribes to, or serves what only itself calls, and the name is not a "
    "private one. Use `~/name`, or a call within the program.",
    Severity.NOTE,
    ("ros", "graph", "names", "reuse"),
    "What only concerns one node collides with another node, or a second one of its kind, that chooses the same name.",
    tool=TOOL,
    scope="configuration",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name whose both ends are in one node alone."""
    if not is_launched(configuration) or unknown_nodes(configuration):
        # Who else uses a name is only known where all that run together are.
        return
    for (kind, name), all_ends in by_name(ends(configuration)).items():
        nodes = {end.node.name for end in all_ends}
        roles = {end.role for end in all_ends}
        if len(nodes) != 1 or len(roles) != 2 or surroundings.is_external(name):
            continue
        end = all_ends[0]
        if end.one.proof.origin is Origin.CODE and not name.startswith(end.node.name + "/"):
            yield _told(kind, end)


def _told(kind: str, end: End) -> Finding:
    severity, doubt = weighed(RULE.severity, (end.one.proof,), end.conditions)
    last = end.name.rpartition("/")[2]
    message = f"only {end.told} itself uses both ends of {kind} {end.name}. Call it `~/{last}`.{doubt}"
    return told(RULE, message, end.one.proof, entity=end.entity, severity=severity)
