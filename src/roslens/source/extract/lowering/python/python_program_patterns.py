"""Patterns of ``match`` in Python as conditions."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.extract.ir.program import Assign, Expression, Literal, Member, Operation
from roslens.source.extract.lowering.python.python_program_expressions import Expressions


class Patterns(Expressions):
    """Lowers the cases of ``match``."""

    def case(self, case: Node, subject: Expression) -> Expression | None:
        """Return the condition of a case; None where there is none."""
        conditions: list[Expression] = []
        for part in self.parts(case):
            if part.type == "case_pattern":
                one = self._pattern(part, subject)
                conditions += [] if one is None else [one]
            elif part.type == "if_clause":
                conditions.append(self._first(part))
        if not conditions:
            return None
        return conditions[0] if len(conditions) == 1 else Operation("and", tuple(conditions))

    def _pattern(self, pattern: Node, subject: Expression) -> Expression | None:
        parts = self.parts(pattern)
        if not parts:
            return None if self.text(pattern) == "_" else self._text_only(pattern)
        inner = parts[0]
        if inner.type == "union_pattern":
            labels = [self._label(part, subject) for part in self.parts(inner)]
            return Operation("or", tuple(labels))
        if inner.type == "dotted_name" and inner.child_count == 1 and len(parts) == 1:
            self.pending.append(Assign(self.expression(inner), subject, line=self.line(inner)))
            return None
        return self._label(inner, subject) if len(parts) == 1 else self._text_only(pattern)

    def _label(self, node: Node, subject: Expression) -> Expression:
        value = self.expression(node)
        if isinstance(value, (Literal, Member)):
            return Operation("==", (subject, value))
        return self._text_only(node)
