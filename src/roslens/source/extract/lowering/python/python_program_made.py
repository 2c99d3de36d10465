"""Constructs without an expression in the IR, lowered as statements before the one they are in.

Comprehensions are loops, assignments within expressions are assignments, functions without name are functions of the
program; see :mod:`~roslens.source.extract.lowering.python.python_program_expressions`.
"""

from __future__ import annotations

import re

from tree_sitter import Node

from roslens.source.extract.ir.program import (
    Assign,
    Branch,
    Evaluate,
    Expression,
    Function,
    Item,
    Lambda,
    Loop,
    Mapping,
    Name,
    Opaque,
    Parameter,
    Return,
    Sequence,
    Statement,
)
from roslens.source.extract.lowering.python.python_program_reading import DEEPEST, Reading
from roslens.source.syntax.python_tree import LANGUAGE

_WORD = re.compile(r"[^\W\d]\w*")


def _kind(name: str) -> int:
    return LANGUAGE.id_for_node_kind(name, True) or 0


_PAIR, _FOR, _IF = _kind("pair"), _kind("for_in_clause"), _kind("if_clause")


class Made(Reading):
    """Makes statements of what expressions of a file do besides."""

    def _first(self, node: Node) -> Expression:
        parts = self.parts(node)
        return self.expression(parts[0]) if len(parts) == 1 else self._opaque(node)

    def _comprehension(self, node: Node) -> Expression:
        parts = self.parts(node)
        if len(parts) < 2 or self._depth + len(parts) > DEEPEST:
            return self._too_deep(node) if len(parts) > 1 else self._text_only(node)
        self._made += 1
        result = Name(f"#{self._made}")
        keyed = parts[0].kind_id == _PAIR
        start: Expression = Mapping(()) if keyed else Sequence(())
        self.pending.append(Assign(result, start, line=self.line(node)))
        names, known, depth = self._names, self._known, self._depth
        self.pending += self._clauses(parts[1:], parts[0], result)
        self._names, self._known, self._depth = names, known, depth
        return result

    def _clauses(self, clauses: list[Node], body: Node, result: Name) -> list[Statement]:
        outer, self.pending = self.pending, []
        self._depth += 1
        if not clauses:
            self._fill(result, body)
        elif clauses[0].kind_id == _FOR:
            left, over = clauses[0].child_by_field_name("left"), clauses[0].child_by_field_name("right")
            sequence = self.expression(over) if over is not None else Opaque("")
            self._rename(left, result.name)
            target = self.expression(left) if left is not None else Opaque("")
            inner = tuple(self._clauses(clauses[1:], body, result))
            self.pending.append(Loop(target, sequence, inner, self.line(clauses[0])))
        else:
            condition = self._first(clauses[0]) if clauses[0].kind_id == _IF else self._text_only(clauses[0])
            inner = tuple(self._clauses(clauses[1:], body, result))
            self.pending.append(Branch(condition, inner, (), self.line(clauses[0])))
        made, self.pending = self.pending, outer
        return made

    def _fill(self, result: Name, body: Node) -> None:
        line = self.line(body)
        if body.kind_id == _PAIR:
            key, value = self.expression(body.children[0]), self.expression(body.children[-1])
            self.pending.append(Assign(Item(result, key), value, line=line))
        else:
            self.pending.append(Assign(result, Sequence((self.expression(body),)), "", "+=", line))

    def _rename(self, target: Node | None, mark: str) -> None:
        written = self.text(target) if target is not None else ""
        if "." not in written and "[" not in written:
            self._names = {**self._names, **{word: f"{word}{mark}" for word in _WORD.findall(written)}}
            self._known = {}

    def _named(self, node: Node) -> Expression:
        return self._bound(node, node.child_by_field_name("name"), node.child_by_field_name("value"))

    def _as_pattern(self, node: Node) -> Expression:
        parts = self.parts(node)
        target = self.parts(parts[-1]) if parts else []
        return self._bound(node, target[0] if target else None, parts[0] if len(parts) > 1 else None)

    def _bound(self, node: Node, name: Node | None, value: Node | None) -> Expression:
        if name is None or value is None:
            return self._opaque(node)
        found = self.expression(value)
        target = self.expression(name)
        self.pending.append(Assign(target, found, line=self.line(node)))
        return target

    def _function_without_name(self, node: Node) -> Expression:
        index = len(self.functions)
        self.functions.append(None)
        parameters = self.parameters(node.child_by_field_name("parameters"))
        body = node.child_by_field_name("body")
        outer, self.pending = self.pending, []
        names, known, scope = self._names, self._known, self.scope
        name = f"{scope}.lambda" if scope else "lambda"
        self.scope = name
        self.shadow(parameters)
        line = self.line(node)
        value = self.expression(body) if body is not None else Opaque("")
        statements = (*self.pending, Return(value, line))
        self.pending, self._names, self._known, self.scope = outer, names, known, scope
        self.functions[index] = Function("lambda", name, line, "", parameters, (), statements)
        return Lambda(index)

    def shadow(self, parameters: tuple[Parameter, ...]) -> None:
        """Take ``parameters`` for themselves, whatever their names mean around the function."""
        taken = {parameter.name for parameter in parameters}.intersection(self._names)
        if taken:
            self._names = {name: meant for name, meant in self._names.items() if name not in taken}
            self._known = {}

    # What is not understood

    def _opaque(self, node: Node) -> Opaque:
        """Return the text of ``node``; calls in it are evaluated before."""
        for part in self.parts(node):
            self.evaluate(part)
        return self._text_only(node)

    def evaluate(self, node: Node) -> None:
        """Keep an expression that calls something as a statement."""
        before = self._calls
        value = self.expression(node)
        if self._calls > before and not isinstance(value, (Opaque, Name, Lambda)):
            self.pending.append(Evaluate(value, self.line(node)))
