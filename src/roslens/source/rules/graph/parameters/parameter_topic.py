"""Rule ``graph.parameter_topic``: a parameter that names a topic which nobody has."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fnmatch import fnmatchcase

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter, Origin
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import is_launched, is_unknown, listed, unknown_nodes
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.parameter_topic",
    "Parameter with an unknown topic",
    "A parameter whose name ends with `topic` is set to a global name below a node or namespace that does not exist, "
    "and no node of the configuration has a topic of that name. Only nodes with known code are checked; names that "
    "may belong to unknown parts, and names whose other end is usually outside the workspace, are not reported. It is "
    "a warning in a configuration that `roslens.toml` declares to be the whole system, otherwise a note. Correct the "
    "value, or start the node that has the topic.",
    Consequence.WRONG,
    Certainty.LIKELY,
    ("ros", "graph", "parameters", "names", "launch"),
    "The intended connection is missing, as after copying the parameters of another node.",
)
_GLOBAL = re.compile(r"/[A-Za-z]\w*(?:/[A-Za-z]\w*)+")
_TOPIC = re.compile(r"(?:\A|[_./])topic(?:_name)?\Z", re.IGNORECASE)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each parameter that names a topic which no node has."""
    if not is_launched(configuration):
        return
    unknown = unknown_nodes(configuration)
    names = {one.endpoint.name for node in configuration.nodes for one in node.endpoints}
    patterns = [name for name in names if "*" in name]
    spaces = {space for name in (*names, *(node.name for node in configuration.nodes)) for space in _spaces(name)}
    for node in configuration.nodes:
        for one, topic in _topics_named(node, ros1=configuration.generation == "ros1"):
            if "/" + topic.split("/")[1] in spaces:
                continue
            if not any(fnmatchcase(topic, other) for other in (*patterns, *surroundings.external)):
                yield _told(one, node, [other.name for other in unknown], whole=surroundings.whole)


def _topics_named(node: ConfiguredNode, *, ros1: bool) -> Iterator[tuple[ConfiguredParameter, str]]:
    """Yield the parameters of a node that name a topic, with its name."""
    if not _is_understood(node):
        return
    for one in node.parameters:
        value = one.value or ""
        if one.set_by is None or not _TOPIC.search(one.name) or not _GLOBAL.fullmatch(value):
            continue
        if _own(one, node, ros1=ros1):
            yield one, value


def _is_understood(node: ConfiguredNode) -> bool:
    return node.defined is not None and node.defined.origin is Origin.CODE and not is_unknown(node)


def _spaces(name: str) -> Iterator[str]:
    """Yield the outermost namespace of a name."""
    if name.startswith("/"):
        yield "/" + name.split("/")[1]


def _own(one: ConfiguredParameter, node: ConfiguredNode, *, ros1: bool) -> bool:
    return not ros1 or one.name.startswith(f"{node.name}/")


def _told(one: ConfiguredParameter, node: ConfiguredNode, unknown: list[str], *, whole: bool) -> Finding:
    more = f"the topics of {listed(unknown)} are unknown" if unknown else ""
    # What is not in the configuration may be started beside it.
    usual = RULE.certainty if whole else Certainty.HEURISTIC
    certainty, doubt = weighed(usual, (one.set_by,), (*node.conditions, *one.conditions), more=more)
    proof = one.set_by
    assert proof is not None  # noqa: S101 - only parameters that are set are reported
    space = "/" + (one.value or "").split("/")[1]
    unread = "" if one.access else f" {node.name} is not known to use the parameter."
    message = (
        f"parameter `{one.name}` is set to `{one.value}`, a topic that no node has: there is no node and no name in "
        f"`{space}`.{unread} Correct the name, or start the node that has the topic."
    )
    return occurrence(
        RULE,
        message,
        proof,
        entity=f"parameter:{node.name}:{one.name}",
        certainty=certainty,
        context=one.name,
        doubt=doubt,
    )
