"""The value that something outside of a node sets for one of its parameters."""

from __future__ import annotations

import json
import re

from roslens.model.configuration import ConfiguredNode, ConfiguredParameter
from roslens.report.graph.parameter_value import yaml_value

_PLAIN = re.compile(r"\s*(?:[-+]?\d+(?:\.\d*)?|true|false)\s*\Z")


def set_value(one: ConfiguredParameter) -> str | None:
    """Return as YAML what is set for a parameter, or its default; None where that is unknown or no YAML of its type."""
    text = one.set_value if one.written_by is not None and one.set_value is not None else one.value
    if one.written_by is not None and one.set_value is None:
        # Code gives it its value: what is set before is overwritten, so its default stands for it.
        text = one.default
    if text is None or "*" in one.name:
        return None
    kind = (one.set_type or one.type) if one.set_by is not None else one.type
    if kind:
        return yaml_value(text, kind)
    return text.strip() if _PLAIN.match(text) else json.dumps(text) if one.set_by is None else None


def unknown_reason(one: ConfiguredParameter) -> str:
    """Return why the value of a parameter cannot be stated."""
    if "*" in one.name:
        return "a part of its name is unknown"
    if one.set_by is None:
        return "it has no default that is known"
    how = f" ({one.set_by.how})" if one.set_by.how else ""
    return f"its value is known only while it runs{how}"


def listed(node: ConfiguredNode) -> list[ConfiguredParameter]:
    """Return the parameters of a node but those that only repeat the quality of service of an endpoint."""
    return [one for one in node.parameters if not one.repeats_an_endpoint]
