"""A Python file as a small program, from the tree of the one parse; Python 2 files too.

How expressions are lowered is described in
:mod:`~roslens.source.extract.lowering.python.python_program_expressions`, statements in
:mod:`~roslens.source.extract.lowering.python.python_program_statements`, literals and text put together in
:mod:`~roslens.source.extract.lowering.python.python_program_literals`.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.extract.ir.program import Program
from roslens.source.extract.lowering.python.python_program_statements import Statements
from roslens.source.syntax.python_tree import PythonTree, parse_tree, with_line_feeds

_MOST_FAULTS = 100


def program_of_python(content: bytes) -> Program:
    """Return the program of a Python file; never fails."""
    return lower_python(parse_tree(with_line_feeds(content)))


def lower_python(parsed: PythonTree, lowered: Statements | None = None) -> Program:
    """Return the program of a parsed Python file.

    Never fails: what was not understood is opaque or left out, and its line is in ``incomplete``.

    Args:
        parsed: the file.
        lowered: what lowers it, where that is to keep more than the program.
    """
    lowered = lowered or Statements(parsed.source)
    root = parsed.tree.root_node
    body = lowered.block(root)
    if root.has_error:
        for fault in _faults(root):
            lowered.note(fault, "not understood")
    incomplete = lowered.incomplete
    incomplete.update((parsed.source.count(b"\n", 0, start) + 1, "not understood") for start, _ in parsed.blanked)
    return Program(
        "python",
        tuple(function for function in lowered.functions if function is not None),
        tuple(one for one in lowered.classes if one is not None),
        body,
        imports=lowered.imports,
        using=tuple(lowered.using),
        includes=tuple(lowered.modules),
        incomplete=tuple(sorted(incomplete)),
    )


def _faults(root: Node) -> Iterator[Node]:
    """Yield the outermost nodes that could not be parsed, as many as are worth telling."""
    nodes = [root]
    reported = 0
    while nodes and reported < _MOST_FAULTS:
        node = nodes.pop()
        if node.is_error or node.is_missing:
            reported += 1
            yield node
        else:
            nodes.extend(child for child in reversed(node.children) if child.has_error or child.is_missing)
