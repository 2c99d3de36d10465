"""A parameter as NoDL 2 declares it: the shape is that of generate_parameter_library (parameter.schema.yaml)."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

from roslens.model.configuration import ConfiguredParameter
from roslens.report.graph.parameter_value import yaml_scalar, yaml_value

_SCALARS = ("bool", "int", "double", "string")
TYPES = frozenset((*_SCALARS, *(f"{one}_array" for one in _SCALARS), "byte_array"))
"""Types that NoDL has a word for."""
_ENDS = re.compile(r"(>?)([^<>]*?)\.\.(<?)([^<>]*)")


def nodl_parameter(one: ConfiguredParameter) -> Iterator[str]:
    """Yield the lines of a parameter whose type is among :data:`TYPES`."""
    yield f"  {json.dumps(one.name)}:"
    yield f"    type: {one.type}"
    if (default := _default(one)) is not None:
        yield f"    default_value: {default}"
    if one.description:
        yield f"    description: {json.dumps(one.description)}"
    if one.read_only:
        yield "    read_only: true"
    if one.constraints:
        yield f"    additional_constraints: {json.dumps('; '.join(one.constraints))}"
    checks = dict(_checks(one))
    if checks:
        yield "    validation:"
        yield from (f"      {name}: {values}" for name, values in checks.items())


def _default(one: ConfiguredParameter) -> str | None:
    """Return a default as YAML; None where its text does not fit its type."""
    return None if one.default is None else yaml_value(one.default, one.type)


def _checks(one: ConfiguredParameter) -> Iterator[tuple[str, str]]:
    """Yield the validators that a range and values come to."""
    found = _ENDS.fullmatch(one.range)
    if found is not None and one.type in ("int", "double"):
        above, least, under, greatest = found.groups()
        low, high = (yaml_scalar(end, one.type) if end else None for end in (least, greatest))
        yield from _bounds(low, high, above=bool(above), under=bool(under))
    allowed = [yaml_scalar(text, one.type) for text in one.allowed] if one.type in _SCALARS else []
    if allowed and None not in allowed:
        yield "one_of<>", f"[[{', '.join(text for text in allowed if text is not None)}]]"


def _bounds(low: str | None, high: str | None, *, above: bool, under: bool) -> Iterator[tuple[str, str]]:
    """Yield the validators of a range; ``above`` and ``under`` say that its ends do not belong to it."""
    if low is not None and high is not None and not above and not under:
        yield "bounds<>", f"[{low}, {high}]"
        return
    if low is not None:
        yield "gt<>" if above else "gt_eq<>", f"[{low}]"
    if high is not None:
        yield "lt<>" if under else "lt_eq<>", f"[{high}]"
