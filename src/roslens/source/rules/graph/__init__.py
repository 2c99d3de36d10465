"""The plug-in ``graph``: rules on the computation graph that source and launch files come to."""

from __future__ import annotations

from typing import Any

import msgspec

from roslens.model.configuration import Configuration
from roslens.plugins.points import INTERFACE_VERSION, Manifest, Option, Report
from roslens.source.rules.graph.findings import RULES, graph_findings
from roslens.source.rules.graph.surroundings import COMMAND_TOPICS, EXTERNAL, FAST_HZ, Surroundings


class ConfigurationInput(msgspec.Struct, frozen=True):
    """A configuration as the hook sees it: what would run together, what is around it, and the options."""

    configuration: Configuration
    surroundings: Surroundings = Surroundings()
    options: dict[str, Any] = {}


class GraphRules:
    """Finds what does not fit together in a configuration."""

    manifest = Manifest(
        name="graph",
        interface=INTERFACE_VERSION,
        version="1.0",
        text="Finds inconsistencies in the computation graph: names, types, quality of service, parameters.",
        scopes=("configuration",),
        rules=tuple(rule for rule, _found in RULES),
        options=(
            Option("command_topics", "list", "Patterns of topics whose messages cause motion.", list(COMMAND_TOPICS)),
            Option(
                "external",
                "list",
                "Patterns of names whose other end is usually outside the workspace.",
                list(EXTERNAL),
            ),
            Option("fast_hz", "float", "Rate from which a topic is considered fast, in messages per second.", FAST_HZ),
        ),
    )

    def analyse_configuration(self, given: ConfigurationInput, report: Report) -> None:
        """Report what the rules find."""
        for one in graph_findings(given.configuration, with_options(given.surroundings, given.options)):
            report.finding(one.rule, one.message, path=one.path, line=one.line, column=one.column, entity=one.entity)


def with_options(surroundings: Surroundings, options: dict[str, Any]) -> Surroundings:
    """Return surroundings with what users set in ``[options.graph]``; lists take the place of the usual ones."""
    changes = {name: options[name] for name in ("command_topics", "external", "fast_hz") if name in options}
    return msgspec.structs.replace(
        surroundings, **{name: tuple(value) if isinstance(value, list) else value for name, value in changes.items()}
    )


plugin = GraphRules()

__all__ = ["ConfigurationInput", "GraphRules", "graph_findings", "plugin", "with_options"]
