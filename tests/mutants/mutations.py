"""Every place of a source that can be changed, and what it is changed to."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

_COMPARED = {
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==",
    "is": "is not", "is not": "is", "in": "not in", "not in": "in",
}  # fmt: skip
_COMPUTED = {
    "+": "-", "-": "+", "*": "+", "/": "*", "//": "*", "%": "+", "**": "*",
    "<<": ">>", ">>": "<<", "&": "|", "|": "&", "^": "|", "@": "+",
}  # fmt: skip
_COMPARISON = re.compile(r"not\s+in\b|is\s+not\b|<=|>=|==|!=|<|>|in\b|is\b")
_OPERATOR = re.compile(r"\*\*|//|<<|>>|[-+*/%&|^@]")
_LOGIC = re.compile(r"\band\b|\bor\b")
_SPOKEN = frozenset({"what", "where", "expected", "advice", "help", "metavar", "description", "epilog"})
_SPEAKING = re.compile(r"(Error|Failure|Warning|print|say|append|HTTPException|PlainTextResponse|Note)$")


class Mutation(NamedTuple):
    """A change of a source: characters from ``start`` to ``end`` become ``text``."""

    start: int
    end: int
    text: str
    line: int
    kind: str

    def of(self, source: str) -> str:
        """Return the source with the change."""
        return source[: self.start] + self.text + source[self.end :]


def mutations(source: str) -> list[Mutation]:
    """Return what can be changed, in the order of its places.

    Left out is what has no behaviour or says it in words: annotations, what is imported for them, docstrings,
    decorators, options of classes, and texts of messages, all that is put together in `f"…"` among them.
    """
    return sorted(set(_Places(source).all()))


class _Places:
    def __init__(self, source: str) -> None:
        self._source = source
        self._tree = ast.parse(source)
        self._starts = [0]
        for line in source.splitlines(keepends=True):
            self._starts.append(self._starts[-1] + len(line))
        self._lines = source.splitlines()

    def all(self) -> Iterator[Mutation]:
        yield from self._below(self._tree)

    def _at(self, line: int, column: int) -> int:
        # Columns count bytes.
        return self._starts[line - 1] + len(self._lines[line - 1].encode()[:column].decode())

    def _span(self, node: ast.AST) -> tuple[int, int]:
        return self._at(node.lineno, node.col_offset), self._at(node.end_lineno, node.end_col_offset)

    def _below(self, node: ast.AST) -> Iterator[Mutation]:
        for child in _with_behaviour(node):
            yield from self._of(child)
            yield from self._below(child)

    def _change(self, start: int, end: int, text: str, kind: str) -> Mutation:
        return Mutation(start, end, text, self._source.count("\n", 0, start) + 1, kind)

    def _of(self, node: ast.AST) -> Iterator[Mutation]:
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            for left, right in pairwise(sides):
                yield from self._between(left, right, _COMPARISON, _COMPARED, "comparison")
        elif isinstance(node, ast.BinOp):
            yield from self._between(node.left, node.right, _OPERATOR, _COMPUTED, "operator")
        elif isinstance(node, ast.BoolOp):
            for left, right in pairwise(node.values):
                yield from self._between(left, right, _LOGIC, {"and": "or", "or": "and"}, "logic")
        elif isinstance(node, ast.Constant):
            yield from self._constant(node)
        elif isinstance(node, (ast.If, ast.While, ast.IfExp)):
            yield self._negated(node.test)
        elif isinstance(node, ast.comprehension):
            yield from (self._negated(test) for test in node.ifs)
        else:
            yield from self._statement(node)

    def _statement(self, node: ast.AST) -> Iterator[Mutation]:
        start, end = self._span(node) if hasattr(node, "lineno") else (0, 0)
        if isinstance(node, ast.Return):
            if node.value is not None and not _is_constant(node.value, None):
                yield self._change(start, end, "return None", "result")
        elif isinstance(node, (ast.Raise, ast.AugAssign)):
            yield self._change(start, end, "pass", "left out")
        elif isinstance(node, ast.Expr) and isinstance(node.value, (ast.Call, ast.Yield, ast.YieldFrom, ast.Await)):
            if isinstance(node.value, ast.Call):
                yield self._change(start, end, "pass", "left out")
        elif isinstance(node, ast.Break):
            yield self._change(start, end, "continue", "loop")
        elif isinstance(node, ast.Continue):
            yield self._change(start, end, "break", "loop")

    def _negated(self, test: ast.expr) -> Mutation:
        start, end = self._span(test)
        if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            return self._change(start, end, f"({self._source[slice(*self._span(test.operand))]})", "condition")
        return self._change(start, end, f"(not ({self._source[start:end]}))", "condition")

    def _between(
        self, left: ast.AST, right: ast.AST, form: re.Pattern[str], other: dict[str, str], kind: str
    ) -> Iterator[Mutation]:
        start, end = self._span(left)[1], self._span(right)[0]
        if found := form.search(self._source, start, end):
            word = " ".join(found[0].split())
            yield self._change(*found.span(), other[word], kind)

    def _constant(self, node: ast.Constant) -> Iterator[Mutation]:
        value = node.value
        start, end = self._span(node)
        if isinstance(value, bool):
            yield self._change(start, end, str(not value), "constant")
        elif isinstance(value, (int, float)):
            yield self._change(start, end, f"({self._source[start:end]} + 1)", "number")
        elif isinstance(value, str) and self._source[start] in "\"'r":
            yield self._change(start, end, '""' if value else '"x"', "text")
        elif isinstance(value, bytes):
            yield self._change(start, end, 'b""' if value else 'b"x"', "text")


def _with_behaviour(node: ast.AST) -> Iterator[ast.AST]:
    for name, value in ast.iter_fields(node):
        if name in ("decorator_list", "annotation", "returns", "keywords") and not isinstance(node, ast.Call):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not _is_talk(node, child):
                yield child


def _is_talk(node: ast.AST, child: ast.AST) -> bool:
    """Whether a part is there for readers or type checkers alone."""
    if isinstance(child, ast.Expr) and isinstance(child.value, ast.Constant):
        return True
    if isinstance(child, (ast.Import, ast.ImportFrom, ast.JoinedStr)):
        return True
    if isinstance(child, ast.If) and isinstance(child.test, ast.Name) and child.test.id == "TYPE_CHECKING":
        return True
    if isinstance(child, ast.keyword) and child.arg in _SPOKEN:
        return True
    return isinstance(node, ast.Call) and _is_text(child) and bool(_SPEAKING.search(ast.unparse(node.func)))


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _is_constant(node: ast.AST, value: object) -> bool:
    return isinstance(node, ast.Constant) and node.value is value
