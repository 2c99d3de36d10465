"""Nodes that others ask for, as further patterns of a query: going through a tree costs most, not what is found.

What is asked for is a type of nodes, ``throw_statement``, or a shape: a pattern of tree-sitter's query language in
which ``@node`` stands behind the node that is meant, ``(else_clause (if_statement) @node)``. What a shape leaves out is
never seen by Python. A shape with many alternatives, or one that waits for a child of something long, costs each node
of the tree: ``benchmarks/rules_speed.py`` tells.
"""

from __future__ import annotations

from collections.abc import Mapping, MutableMapping, Sequence, Set
from functools import cache

from tree_sitter import Node

_CAPTURE = "asked."


def patterns_of(asked: Set[str]) -> str:
    """Return the patterns of what is asked for, to be put behind those of a query."""
    return "".join(f"{_pattern(one, f'@{_CAPTURE}{number}')}\n" for number, one in enumerate(sorted(asked)))


def taken_from(captured: MutableMapping[str, list[Node]], asked: Set[str]) -> Mapping[str, Sequence[Node]]:
    """Take what was asked for out of the captures of such a query, by what was asked."""
    found: dict[str, Sequence[Node]] = dict.fromkeys(asked, ())
    names = _names_of_captures(frozenset(asked))
    for name in names.keys() & captured.keys():
        found[names[name]] = captured.pop(name)
    return found


@cache
def _names_of_captures(asked: frozenset[str]) -> Mapping[str, str]:
    return {f"{_CAPTURE}{number}": one for number, one in enumerate(sorted(asked))}


def _pattern(asked: str, capture: str) -> str:
    return asked.replace("@node", capture) if asked.startswith(("(", "[")) else f"({asked}) {capture}"
