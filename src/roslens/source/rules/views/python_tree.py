"""The syntax tree of a file of Python, as Python itself reads it."""

from __future__ import annotations

import ast
import warnings


def python_tree(content: bytes) -> ast.Module | None:
    """Return the tree of a file; None where this Python cannot read it, which other rules tell."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(content)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
