"""Which classes of a Python file are derived from ``rclpy.node.Node`` alone."""

from __future__ import annotations

import re

from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import PythonClass

_IMPORTED = re.compile(rb"from\s+rclpy(?:\.node)?\s+import\b[^\n]*\bNode\b(?!\s+as\b)")


def is_derived_node(of: PythonClass, view: FileView) -> bool:
    """Return whether the one base of a class is the node of rclpy."""
    if of.bases == ("rclpy.node.Node",):
        return True
    return of.bases == ("Node",) and view.has(_IMPORTED)
