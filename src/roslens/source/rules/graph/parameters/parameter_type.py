"""Rule ``graph.parameter_type``: a parameter set with another type than it is declared with."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.parameter_type",
    "Parameter with the wrong type",
    "A parameter is set with a value of another type than the code declares or reads, by the rules of YAML: `1` is an "
    'integer, `1.0` a double, `"1"` a string. ROS 2 is strict, also between integer and double; ROS 1 converts '
    "numbers. Write the value in the type that the code expects.",
    Consequence.STOPS_START,
    Certainty.PROVEN,
    ("ros", "graph", "parameters", "launch"),
    "In ROS 2 the node ends at start with an exception that names no file; in ROS 1 the default is used silently.",
)
_NUMBERS = frozenset({"int", "double"})
_KNOWN = frozenset(
    {"bool", "int", "double", "string", "bool_array", "byte_array", "int_array", "double_array", "string_array", "map"}
)


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each parameter that is set with a type that does not fit."""
    ros1 = configuration.generation == "ros1"
    for node in configuration.nodes:
        for one in node.parameters:
            taken = one.set_by is not None and one.proof is not None and one.access != "written" and not one.dynamic
            if taken and _differs(one, ros1=ros1):
                yield _told(node, one, ros1=ros1)


def _differs(one: ConfiguredParameter, *, ros1: bool) -> bool:
    wanted, given = one.type, one.set_type
    if not {wanted, given} <= _KNOWN or given in (wanted, *one.other_types) or "" in one.other_types:
        return False
    if ros1:
        # What Python reads has the type of the value; roscpp converts numbers.
        return not _is_kept(one) and not {wanted, given} <= _NUMBERS and "array" not in wanted + given
    return one.access == "declared"


def _is_kept(one: ConfiguredParameter) -> bool:
    """Whether Python takes what is set as it is: code that reads it, or a server of dynamic_reconfigure (ROS 1)."""
    if one.access == "declared":
        return one.written_by is None
    return one.proof is not None and one.proof.path.endswith(".py")


def _told(node: ConfiguredNode, one: ConfiguredParameter, *, ros1: bool) -> Finding:
    proof, code = one.set_by, one.proof
    assert proof is not None  # noqa: S101 - only parameters that are set are reported
    assert code is not None  # noqa: S101
    certainty, doubt = weighed(
        Certainty.LIKELY if ros1 else RULE.certainty, (proof, code), (*node.conditions, *one.conditions)
    )
    value = _set_value(one)
    shown = f" (`{value}`)" if value is not None else ""
    effect = "the default is used" if ros1 else "the node does not start"
    message = (
        f"parameter `{one.name}` of {node.name} is set as {one.set_type}{shown}; {code.place} "
        f"{one.access or 'reads'} it as {one.type}: {effect}. {_advice(one)}"
    )
    entity = f"parameter:{node.name}:{one.name}"
    return occurrence(
        RULE,
        message,
        proof,
        entity=entity,
        certainty=certainty,
        consequence=Consequence.WRONG if ros1 else None,
        context=f"{one.set_type} {one.type}",
        doubt=doubt,
    )


def _set_value(one: ConfiguredParameter) -> str | None:
    """Return the value that is set, though code may write another one."""
    return one.value if one.set_value is None else one.set_value


def _advice(one: ConfiguredParameter) -> str:
    value = _set_value(one)
    if one.type == "double" and one.set_type == "int" and value is not None:
        return f"Write `{value}.0`."
    if one.type == "string" and value is not None:
        return f'Write `"{value}"`.'
    if one.type == "byte_array" and one.default == "[]" and one.set_type.endswith("_array"):
        kind = one.set_type.removesuffix("_array").replace("int", "integer").upper()
        return f"An empty list is one of bytes to rclpy: declare it with `rclpy.Parameter.Type.{kind}_ARRAY`."
    return f"Write a value of type {one.type}."
