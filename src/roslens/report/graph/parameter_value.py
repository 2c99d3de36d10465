"""The value of a parameter as YAML, from its text and its type."""

from __future__ import annotations

import json
import math


def yaml_value(text: str, kind: str) -> str | None:
    """Return a value as YAML in one line; None where its text does not fit its type, or its type is unknown.

    Args:
        text: of the value, as graphs have it: texts stand without quotes, also those of a list.
        kind: ``bool``, ``int``, ``double``, ``string``, or one of these with ``_array``; ``byte_array``.
    """
    if not kind.endswith("_array"):
        return yaml_scalar(text, kind)
    text = text.strip()
    if not (text.startswith("[") and text.endswith("]")):
        return None
    items = [part.strip() for part in text[1:-1].split(",") if part.strip()]
    of = kind.removesuffix("_array")
    # A comma or quote inside of a text cannot be distinguished from one between texts.
    plain = [yaml_scalar(part.strip("'\""), "int" if of == "byte" else of) for part in items]
    return None if None in plain else f"[{', '.join(part for part in plain if part is not None)}]"


def yaml_scalar(text: str, kind: str) -> str | None:
    """Return a value that is no list as YAML; see :func:`yaml_value`."""
    if kind == "string":
        return json.dumps(text)
    if kind == "bool":
        return text.lower() if text.lower() in ("true", "false") else None
    if kind not in ("int", "double"):
        return None
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
