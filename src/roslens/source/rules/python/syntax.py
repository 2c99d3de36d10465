"""Rule ``python.syntax``: a file that Python does not compile, by its own compiler; nothing of the file runs."""

from __future__ import annotations

import re
import sys
import warnings
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.python.python2_syntax import has_statement_of_python2
from roslens.source.rules.rule import FileRule

_TEMPLATE = re.compile(rb"^\s*\{%|^@(?:\[|\{)", re.MULTILINE)
_TEMPLATE_LINE = re.compile(rb"\{\{|\}\}|\{%|@[\[({]|\$\{|<%|<#")
_CONFLICT = re.compile(rb"^(?:<{7} |={7}$|>{7} )")
_LARGEST_BYTES = 1_000_000
"""What is larger was generated, and takes hundreds of times its size to compile."""
_NESTED_QUOTES = (3, 12)
"""The Python since which an expression in a format string may have its quotes: ``f"{spin["speed"]:.2f}"``."""
_OF_ANY_VERSION = re.compile(
    r"argument|outside|not properly in loop|declaration|nonlocal|cannot (?:assign|delete)|leading zeros|decimal literal"
    r"|import \*|__future__"
)
"""What no version of Python will allow, though the grammar is satisfied; other texts may be of a later grammar."""


def found(root: Node, view: FileView) -> Iterator[Hit]:
    """Yield where the compiler of the Python that runs here stops, unless a later Python may go on there."""
    error = _refused(view.content)
    if error is None or error.lineno is None:
        return
    text = error.msg or "invalid syntax"
    if not (root.has_error or isinstance(error, IndentationError) or _OF_ANY_VERSION.search(text)):
        return
    if not root.has_error and sys.version_info < _NESTED_QUOTES and _is_in_format(root, error.lineno):
        return
    line = view.lines[error.lineno - 1] if 0 < error.lineno <= len(view.lines) else b""
    if _TEMPLATE.search(view.content) or _TEMPLATE_LINE.search(line) or has_statement_of_python2(view):
        return
    if _CONFLICT.match(line):
        text = "a merge conflict that is not resolved"
    message = f"Python does not compile the file: {text}; expected Python 3. Try `python3 -m py_compile` on it"
    yield view.hit_at("python.syntax", error.lineno, message, column=error.offset or 0)


def _is_in_format(root: Node, line: int) -> bool:
    """Return whether a format string with an expression in it stands at a line, 1-based."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if not node.start_point[0] < line <= node.end_point[0] + 1:
            continue
        if node.type == "string" and any(one.type == "interpolation" for one in node.children):
            return True
        waiting += node.children
    return False


def _refused(content: bytes) -> SyntaxError | None:
    """Return what the compiler says of a file; None where it is content, or where other rules tell."""
    if len(content) > _LARGEST_BYTES:
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            compile(content, "<file>", "exec", dont_inherit=True)
        except SyntaxError as error:
            return error
        except (ValueError, MemoryError, RecursionError, OverflowError):
            # Zero bytes, and what is nested too deep for this Python: both are told as what could not be read.
            return None
    return None


RULE = FileRule(
    id="python.syntax",
    title="Python that does not compile",
    finds="A file that the compiler of Python refuses: a bracket that is not closed, a missing comma or colon, tabs "
    "mixed with spaces, an argument given twice, a merge conflict. Where only a later Python would accept it, or the "
    "file is a template, nothing is reported; statements of Python 2 are `python.python2_syntax`.",
    why="Python ends with a SyntaxError before the first line runs: the node, launch file or setup.py does not start, "
    "nor does whatever imports it.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=(),
    clauses=("pylint E0001", "ruff invalid-syntax"),
    syntax="python",
    whole=True,
    bad="def stop(robot):\n    robot.move(0.0, 0.0\n    robot.lock()",
    good="def stop(robot):\n    robot.move(0.0, 0.0)\n    robot.lock()",
    found=found,
)
