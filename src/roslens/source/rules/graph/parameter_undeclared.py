"""Rule ``graph.parameter_undeclared``: a parameter that is set and that no code knows."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter, Origin
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import is_unknown
from roslens.source.rules.graph.likeness import nearest_name
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.told import TOOL, told

RULE = RuleInfo(
    "graph.parameter_undeclared",
    "Parameter that nobody knows",
    "A launch file or a file of parameters sets a parameter that the node never declares (ROS 2) or reads (ROS 1). "
    "Nodes whose code is unknown are left out, and so is what every node has. Correct the name, or remove it.",
    Severity.WARNING,
    ("ros", "graph", "parameters", "launch"),
    "The value is ignored without a word and the node runs with its default.",
    tool=TOOL,
    scope="configuration",
)
_OF_EVERY_NODE = frozenset({"use_sim_time", "start_type_description_service"})
_PREFIXES = ("qos_overrides.", "diagnostic_updater.")


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each parameter that is set and not known by the node it is set for."""
    ros1 = configuration.generation == "ros1"
    open_nodes = {one.node for one in configuration.unresolved if one.node}
    read = [one.name for node in configuration.nodes for one in node.parameters if one.access] if ros1 else []
    for node in configuration.nodes:
        if not _is_understood(node):
            continue
        known = [one.name for one in node.parameters if one.access]
        spaces = _spaces(node) if ros1 else None
        unknown = [
            one
            for one in node.parameters
            if (spaces is None or _above(one.name) in spaces) and _is_unknown(one, node, known, read, ros1=ros1)
        ]
        # Where the code is not known to have any, all of them are one problem.
        for one in unknown if known else unknown[:1]:
            yield _told(
                node, one, known, ros1=ros1, is_open=node.name in open_nodes, more=0 if known else len(unknown) - 1
            )


def _spaces(node: ConfiguredNode) -> set[str] | None:
    """Return the namespaces of which servers of dynamic_reconfigure say all parameters; None of a node without any.

    Such nodes load plug-ins as a rule, which may read what is in other namespaces.
    """
    if not any(one.endpoint.type.startswith("dynamic_reconfigure/") for one in node.endpoints):
        return None
    return {_above(one.name) for one in node.parameters if one.access == "declared"}


def _above(name: str) -> str:
    return name.rpartition("/")[0]


def _is_unknown(
    one: ConfiguredParameter, node: ConfiguredNode, known: list[str], read: list[str], *, ros1: bool
) -> bool:
    if one.set_by is None or one.access or _is_of_every_node(one.name) or "*" in one.name:
        return False
    if one.value is None and any(name.startswith(f"{one.name}.") for name in known):
        # It may be a table of parameters, of which nobody knows what is in it.
        return False
    if ros1 and (not one.name.startswith(f"{node.name}/") or _is_read(one.name, read)):
        return False
    return not any("*" in name and _fits(one.name, name) for name in known)


def _is_understood(node: ConfiguredNode) -> bool:
    """Whether its code says all parameters that it has."""
    return not is_unknown(node) and node.defined is not None and node.defined.origin is Origin.CODE and node.resolved


def _is_of_every_node(name: str) -> bool:
    return name in _OF_EVERY_NODE or name.startswith(_PREFIXES)


def _is_read(name: str, read: list[str]) -> bool:
    """Whether some node reads it, or a map that it is in."""
    return any(name == one or name.startswith(one.rstrip("/") + "/") for one in read)


def _fits(name: str, pattern: str) -> bool:
    from fnmatch import fnmatchcase

    return fnmatchcase(name, pattern)


def _told(
    node: ConfiguredNode, one: ConfiguredParameter, known: list[str], *, ros1: bool, is_open: bool, more: int
) -> Finding:
    proof = one.set_by
    assert proof is not None  # noqa: S101 - only parameters that are set are told
    why = ""
    if is_open:
        why = f"not all of the code of {node.name} was understood"
    elif not known:
        why = f"no parameter of the code of {node.name} is known"
    elif "." in one.name and not ros1:
        why = "a plug-in that the node loads may declare it"
    severity, doubt = weighed(RULE.severity, (proof,), node.conditions, more=why)
    near = nearest_name(one.name, known)
    verb = "reads" if ros1 else "declares"
    advice = f"Did you mean `{near}`?" if near else f"Correct the name or remove it; {_knows(known)}."
    where = f" ({node.defined.place})" if node.defined is not None else ""
    what = f"`{one.name}` and {more} more are" if more else f"`{one.name}` is"
    message = (
        f"parameter{'s' if more else ''} {what} set for {node.name}{where}, which never {verb} "
        f"{'any' if more else 'it'}. {advice}{doubt}"
    )
    return told(RULE, message, proof, entity=f"parameter:{node.name}:{one.name}", severity=severity, context=proof.path)


def _knows(known: list[str]) -> str:
    return f"it knows {', '.join(sorted(known)[:5])}{' …' if len(known) > 5 else ''}" if known else "it knows none"
