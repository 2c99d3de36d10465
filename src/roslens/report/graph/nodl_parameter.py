"""A parameter as NoDL 2 declares it: the shape is that of generate_parameter_library (parameter.schema.yaml)."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator

from roslens.model.configuration import ConfiguredParameter

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
    if one.default is None:
        return None
    if not one.type.endswith("_array"):
        return _scalar(one.default, one.type)
    text = one.default.strip()
    if not (text.startswith("[") and text.endswith("]")):
        return None
    items = [part.strip() for part in text[1:-1].split(",") if part.strip()]
    kind = one.type.removesuffix("_array")
    # A comma or quote inside of a text cannot be distinguished from one between texts.
    plain = [_scalar(part.strip("'\""), "int" if kind == "byte" else kind) for part in items]
    return None if None in plain else f"[{', '.join(part for part in plain if part is not None)}]"


def _scalar(text: str, kind: str) -> str | None:
    if kind == "string":
        return json.dumps(text)
    if kind == "bool":
        return text.lower() if text.lower() in ("true", "false") else None
    try:
        return str(int(text, 0)) if kind == "int" else _real(float(text))
    except ValueError:
        return None


def _real(number: float) -> str:
    """Return a number as YAML: what is none, or has no end, has words of its own."""
    if math.isnan(number):
        return ".nan"
    if math.isinf(number):
        return ".inf" if number > 0 else "-.inf"
    return str(number) if "e" not in str(number) or "." in str(number) else str(number).replace("e", ".0e")


def _checks(one: ConfiguredParameter) -> Iterator[tuple[str, str]]:
    """Yield the validators that a range and values come to."""
    found = _ENDS.fullmatch(one.range)
    if found is not None and one.type in ("int", "double"):
        above, least, under, greatest = found.groups()
        low, high = (_scalar(end, one.type) if end else None for end in (least, greatest))
        yield from _bounds(low, high, above=bool(above), under=bool(under))
    allowed = [_scalar(text, one.type) for text in one.allowed] if one.type in _SCALARS else []
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
