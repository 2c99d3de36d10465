"""Lists of texts as YAML writes them in one line: what a parameter is set to, or its default."""

from __future__ import annotations

from roslens.source.extract.symbolic.text import Hole


def listed(value: str) -> list[str]:
    """Return the items of a list of texts as YAML in one line."""
    return [one for part in value[1:-1].split(",") if (one := part.strip().strip("\"'"))]


def is_list(hole: Hole) -> bool:
    """Whether the default of a parameter is a list, as YAML in one line."""
    return hole.default is not None and hole.default.startswith("[") and hole.default.endswith("]")
