"""Patterns of ``match`` in Python as conditions."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.extract.ir.program import Assign, Expression, Literal, Member, Opaque, Operation, Sequence
from roslens.source.extract.lowering.python.python_program_expressions import Expressions
from roslens.source.extract.lowering.python.python_program_reading import LONGEST_OPAQUE

_SEQUENCES = ("tuple_pattern", "list_pattern")


class Patterns(Expressions):
    """Lowers the cases of ``match``."""

    def case(self, case: Node, subjects: tuple[Expression, ...]) -> Expression | None:
        """Return the condition of a case for what is looked at, a sequence where it is several; or None."""
        parts = self.parts(case)
        conditions = self._matched([part for part in parts if part.type == "case_pattern"], subjects)
        conditions += [self._first(part) for part in parts if part.type == "if_clause"]
        if not conditions:
            return None
        return conditions[0] if len(conditions) == 1 else Operation("and", tuple(conditions))

    def _matched(self, patterns: list[Node], subjects: tuple[Expression, ...]) -> list[Expression]:
        """Return what patterns ask of the subjects, each of its own."""
        if len(patterns) == 1 and len(subjects) > 1:
            inner = next(iter(self.parts(patterns[0])), None)
            if inner is None or inner.type not in _SEQUENCES:
                whole = self._pattern(patterns[0], Sequence(subjects))
                return [] if whole is None else [whole]
            patterns = self.parts(inner)
        if len(patterns) != len(subjects) or any(_takes_the_rest(one) for one in patterns):
            return [Opaque(", ".join(self._text_only(one).text for one in patterns)[:LONGEST_OPAQUE])]
        asked = [self._pattern(pattern, subject) for pattern, subject in zip(patterns, subjects, strict=True)]
        return [one for one in asked if one is not None]

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


def _takes_the_rest(pattern: Node) -> bool:
    return any(part.type == "splat_pattern" for part in pattern.children)
