"""A configuration for people, whether something starts it or nothing does."""

from __future__ import annotations

from roslens.model.configuration import Configuration
from roslens.report.graph.graph_text import to_graph_text
from roslens.report.graph.unstarted_text import to_unstarted_text


def to_configuration_text(configuration: Configuration) -> str:
    """Return a configuration as lines."""
    return (to_unstarted_text if configuration.unstarted else to_graph_text)(configuration)
