"""Rule ``graph.parameter_range``: a parameter with a value that its declaration does not allow."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import listed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.parameter_range",
    "Parameter out of range",
    "A parameter is set, or declared by default, with a value outside the range of its declaration (`integer_range`, "
    "`floating_point_range`, `bounds<>`, a `.cfg` file), or with a value that is not among the allowed ones "
    "(`one_of<>`). Choose an allowed value, or widen the range.",
    Consequence.STOPS_START,
    Certainty.PROVEN,
    ("ros", "graph", "parameters", "launch"),
    "In ROS 2 the node ends at start with an exception that names no file; in ROS 1 dynamic_reconfigure uses the "
    "nearest limit of the range.",
)
_RANGE = re.compile(r"(>?)([^<>]*?)\.\.(<?)([^<>]*)")
_NUMBERS = frozenset({"int", "double"})


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each parameter whose value is not allowed."""
    ros1 = configuration.generation == "ros1"
    for node in configuration.nodes:
        for one in node.parameters:
            if one.proof is not None and one.value is not None and (one.range or one.allowed):
                wanted = _broken(one)
                if wanted:
                    yield _told(node, one, wanted, ros1=ros1)


def _broken(one: ConfiguredParameter) -> str:
    """Return what is asked of a value in words; empty where it fits, or is of another type."""
    given = one.set_type if one.set_by is not None else one.type
    value = _given(one) or ""
    # Where a server makes another number of it, it converts.
    fits = given in ("", one.type) or (one.set_value is not None and {given, one.type} <= _NUMBERS)
    if one.type not in {"string", *_NUMBERS} or not fits:
        return ""
    if one.allowed and not any(_same(value, other, one.type) for other in one.allowed):
        return f"one of {listed([f'`{other}`' for other in one.allowed])}"
    return f"`{one.range}`" if one.type in _NUMBERS and _outside(value, one.range) else ""


def _given(one: ConfiguredParameter) -> str | None:
    """Return the value that is set, though code may take another one."""
    return one.value if one.set_value is None else one.set_value


def _same(value: str, other: str, kind: str) -> bool:
    if kind == "string":
        return value == other
    first, second = number_of(value), number_of(other)
    # What is no number here may be one to ROS.
    return first is None or second is None or first == second


def _outside(value: str, written: str) -> bool:
    match, number = _RANGE.fullmatch(written), number_of(value)
    if match is None or number is None:
        return False
    above, least, under, greatest = match.groups()
    low, high = number_of(least), number_of(greatest)
    too_low = low is not None and (number < low or (bool(above) and number == low))
    return too_low or (high is not None and (number > high or (bool(under) and number == high)))


def number_of(text: str) -> float | None:
    """Return a number as ROS reads it; None of a text that is none."""
    try:
        return float(int(text, 0))
    except (ValueError, OverflowError):
        pass
    try:
        return float(text)
    except ValueError:
        return None


def _told(node: ConfiguredNode, one: ConfiguredParameter, wanted: str, *, ros1: bool) -> Finding:
    code = one.proof
    assert code is not None  # noqa: S101 - only parameters that code declares are reported
    place, value = one.set_by or code, _given(one)
    certainty, doubt = weighed(
        Certainty.LIKELY if ros1 else RULE.certainty, (one.set_by, code), (*node.conditions, *one.conditions)
    )
    how = "set to" if one.set_by is not None else "by default"
    where = f"{code.place} allows" if one.set_by is not None else "its declaration allows"
    effect = "the nearest end is used" if ros1 else "the node does not start"
    message = f"parameter `{one.name}` of {node.name} is {how} `{value}`; {where} {wanted}: {effect}."
    entity = f"parameter:{node.name}:{one.name}"
    return occurrence(
        RULE, message, place, entity=entity, certainty=certainty, context=f"{value} {wanted}", doubt=doubt
    )
