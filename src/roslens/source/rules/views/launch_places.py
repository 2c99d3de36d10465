"""Where a keyword of a call in a launch file in Python stands, for findings about what is given by it."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from functools import lru_cache

from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.views.python_tree import python_tree


def keyword_place(view: PackageView, at: Evidence, keyword: str) -> tuple[int, int]:
    """Return line and column of the value that a keyword has in the call at a place; of the call where it has none."""
    if not at.path.endswith(".py"):
        return at.line, at.column
    return _places(view.read(at.path)).get((at.line, keyword), (at.line, at.column))


@lru_cache(maxsize=8)
def _places(content: bytes) -> Mapping[tuple[int, str], tuple[int, int]]:
    """Return the places of all keywords, by the line of their call; of calls that share one, those of the first."""
    tree = python_tree(content)
    if tree is None:
        return {}
    found: dict[tuple[int, str], tuple[int, int]] = {}
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        for one in call.keywords:
            if one.arg:
                found.setdefault((call.lineno, one.arg), (one.lineno, one.col_offset + 1))
    return found
