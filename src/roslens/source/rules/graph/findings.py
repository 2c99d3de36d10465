"""All rules of the computation graph, and what they find in a configuration."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding, RuleInfo
from roslens.source.rules.graph import (
    argument,
    command_topic,
    definition,
    dependency,
    executable,
    global_name,
    node_name,
    one_end,
    private_data,
    remap,
    shared_output,
    transform,
    type,  # noqa: A004 - the rule is called so
)
from roslens.source.rules.graph.names import remap_namespace
from roslens.source.rules.graph.parameters import (
    controller_type,
    lifecycle_manager,
    parameter_elsewhere,
    parameter_file,
    parameter_namespace,
    parameter_range,
    parameter_topic,
    parameter_type,
    parameter_undeclared,
    stamped_command,
)
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.timing import deadlock, latched, qos, queue, sim_time

Found = Callable[[Configuration, Surroundings], Iterator[Finding]]

_MODULES = (
    qos, latched, type, definition, one_end, remap, parameter_undeclared, parameter_type, parameter_range,
    parameter_file, parameter_elsewhere, parameter_namespace, parameter_topic, node_name, shared_output, command_topic,
    transform, dependency, executable, argument, sim_time, queue, deadlock, global_name, private_data,
    lifecycle_manager, stamped_command, remap_namespace, controller_type,
)  # fmt: skip
RULES: tuple[tuple[RuleInfo, Found], ...] = tuple((one.RULE, one.found) for one in _MODULES)
"""Each rule and the function that finds its occurrences, in the order in which they are documented."""
_OF_A_SYSTEM = frozenset(
    one.RULE.id
    for one in (
        *(node_name, shared_output, command_topic, transform, sim_time, latched, lifecycle_manager),
        remap_namespace,
    )
)
"""Rules that say nothing of nodes of which nobody knows whether they run together."""


def graph_findings(configuration: Configuration, surroundings: Surroundings | None = None) -> list[Finding]:
    """Return what is wrong with a configuration, sorted by place; the same input gives the same findings.

    Args:
        configuration: what would run together.
        surroundings: the workspace around it; without it rules that need it find nothing.
    """
    known = surroundings or Surroundings()
    all_found = {
        finding
        for rule, found in RULES
        if known.together or rule.id not in _OF_A_SYSTEM
        for finding in found(configuration, known)
    }
    return sorted(all_found, key=lambda one: (one.path, one.line, one.column, one.rule, one.entity, one.message))
