"""The parameters of the nodes of a configuration, as a YAML file for ``--params-file`` (in ROS 1 for ``rosparam``).

A value that is set stands with the place that sets it, a default with none; what cannot be known without running is
left in a comment, so that the file never has a value that nobody set.
"""

from __future__ import annotations

import json
from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredParameter
from roslens.report.graph.set_parameter import listed, set_value, unknown_reason


def to_parameters(configuration: Configuration) -> str:
    """Return the parameters of a configuration as one YAML document."""
    return "".join(f"{line}\n" for line in _lines(configuration))


def _lines(configuration: Configuration) -> Iterator[str]:
    yield f"# {_comment(configuration.title)}"
    if configuration.generation == "ros1":
        yield from _ros1(configuration)
        return
    for node in configuration.nodes:
        parameters = listed(node)
        if not parameters:
            continue
        if not node.resolved:
            yield f"# {_comment(node.name)}: a part of its name is unknown"
            continue
        known = [one for one in parameters if set_value(one) is not None]
        if known:
            yield f"{json.dumps(node.name)}:"
            yield "  ros__parameters:"
        else:
            yield f"# {_comment(node.name)}:"
        yield from _of_node(parameters)


def _of_node(parameters: list[ConfiguredParameter]) -> Iterator[str]:
    for one in parameters:
        value = set_value(one)
        if value is None:
            yield f"    # {_comment(one.name)}: {_comment(unknown_reason(one))}"
        else:
            yield f"    {json.dumps(one.name)}: {value}{_origin(one)}"


def _ros1(configuration: Configuration) -> Iterator[str]:
    """Yield the parameters of ROS 1 by their resolved names: those of nodes and those set outside of them."""
    every = [*configuration.parameters, *(one for node in configuration.nodes for one in node.parameters)]
    for name, one in sorted({one.name: one for one in every}.items()):
        value = set_value(one)
        if value is None:
            yield f"# {_comment(name)}: {_comment(unknown_reason(one))}"
        else:
            yield f"{json.dumps(name)}: {value}{_origin(one)}"


def _origin(one: ConfiguredParameter) -> str:
    if one.set_by is None:
        return "  # default"
    doubt = ", may be set otherwise" if one.uncertain or one.set_by.sure != "certain" else ""
    return f"  # {_comment(one.set_by.place)}{doubt}"


def _comment(text: str) -> str:
    return " ".join(text.split())
