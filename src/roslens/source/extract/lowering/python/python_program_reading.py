"""What lowering a Python file knows while it reads: the source, where it is, what names mean, what was found."""

from __future__ import annotations

import re
from bisect import bisect_right
from itertools import accumulate

from tree_sitter import Node

from roslens.source.extract.ir.program import Expression, Function, Opaque, Parameter, Statement
from roslens.source.syntax.python_names import text_of
from roslens.source.syntax.python_tree import LANGUAGE

DEEPEST = 100
"""Levels of statements and expressions in each other that are followed."""
LONGEST_OPAQUE = 80
"""Characters of an expression of which nothing more is known."""
_COMMENT = LANGUAGE.id_for_node_kind("comment", True) or 0
_SPACE = re.compile(r"\s+")
_BRACKET = re.compile(r"[\[(] | [\])]")


class Reading:
    """The state of lowering one file.

    Attributes:
        source: what was parsed.
        functions: of the file so far; None stands for one whose body is being read.
        pending: statements of the block that is being read.
        incomplete: lines at which something was not lowered, and why.
        scope: qualified name of the function or class that is being read.
    """

    def __init__(self, source: bytes) -> None:
        """Begin with the source that was parsed."""
        self.source = source
        self.functions: list[Function | None] = []
        self.pending: list[Statement] = []
        self.incomplete: set[tuple[int, str]] = set()
        self.scope = ""
        self._depth = 0
        self._calls = 0
        self._made = 0
        self._known: dict[bytes, Expression] = {}
        self._names: dict[str, str] = {}
        self._starts = [0, *accumulate(len(line) + 1 for line in source.split(b"\n"))]

    def expression(self, node: Node) -> Expression:
        """Return the lowering of a node; nothing but its text is known here."""
        return self._text_only(node)

    def parameters(self, node: Node | None) -> tuple[Parameter, ...]:  # noqa: ARG002 - none is known here
        """Return the parameters of a function."""
        return ()

    def line(self, node: Node) -> int:
        """Return the line that ``node`` begins in, from 1 on."""
        return bisect_right(self._starts, node.start_byte)

    def text(self, node: Node) -> str:
        """Return what is written."""
        return text_of(self.source[node.start_byte : node.end_byte])

    def squeezed(self, node: Node | None) -> str:
        """Return what is written with single spaces, and none inside brackets' ends; nothing of None."""
        if node is None:
            return ""
        return _BRACKET.sub(lambda match: match[0].strip(), _SPACE.sub(" ", self.text(node)).strip())

    def parts(self, node: Node) -> list[Node]:
        """Return the children without signs and comments."""
        return [child for child in node.children if child.is_named and child.kind_id != _COMMENT]

    def _text_only(self, node: Node) -> Opaque:
        start = node.start_byte
        written = text_of(self.source[start : min(node.end_byte, start + 4 * LONGEST_OPAQUE)])
        return Opaque(_SPACE.sub(" ", written).strip()[:LONGEST_OPAQUE])

    def _too_deep(self, node: Node) -> Opaque:
        self.note(node, f"nested more than {DEEPEST} levels deep")
        return self._text_only(node)

    def note(self, node: Node, why: str) -> None:
        """Note that ``node`` was not lowered, and why."""
        self.incomplete.add((self.line(node), why))
