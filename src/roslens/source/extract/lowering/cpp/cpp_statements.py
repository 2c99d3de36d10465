"""Statements of C++ as those of a program: assignments, calls, returns, and the control structure around them."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from tree_sitter import Node

from roslens.source.extract.ir.program import (
    NO_EXCEPTION,
    Assign,
    Branch,
    Call,
    Evaluate,
    Expression,
    Format,
    Leave,
    Literal,
    Loop,
    Name,
    Opaque,
    Operation,
    Return,
    Statement,
)
from roslens.source.extract.lowering.cpp.cpp_breaks import Case, fallen_through
from roslens.source.extract.lowering.cpp.cpp_expressions import Expressions
from roslens.source.extract.lowering.cpp.cpp_lowered import DEEPEST, Lowered, name_of, opaque
from roslens.source.extract.lowering.cpp.cpp_slicing import Level, Relevance, is_filling, is_logging
from roslens.source.extract.lowering.cpp.cpp_statement_forms import any_label, ends_case, owned, says_nothing
from roslens.source.extract.lowering.cpp.cpp_types import declared_name
from roslens.source.extract.lowering.cpp.cpp_variables import Statements, Variables, target_of

_Arm = tuple[Statements, Expression, tuple[Statement, ...], int]
"""What stands before a condition, the condition, what it decides, and the line."""


class StatementLowering:
    """Lowers statements into lists.

    Attributes:
        on_definition: what lowers a class, alias, function or directive among statements; says whether it was one.
        sets: members that the last body sets, as far as that was left out.
        in_part: whether a part of the last body was left out.
    """

    on_definition: Callable[[Node, Statements], bool]

    def __init__(self, lowered: Lowered, expressions: Expressions) -> None:
        """Lower for ``lowered``."""
        self._lowered = lowered
        self._expressions = expressions
        self._lower = expressions.lower
        self._variables = Variables(lowered, expressions)
        self._relevance: Relevance | None = None
        self._whole = True
        self._leaves: frozenset[str] = frozenset()
        self.sets: tuple[str, ...] = ()
        self.in_part = False

    def body(self, node: Node, test: bool = False) -> tuple[Statement, ...]:
        """Return the lowered body of a function, or of a ``test``, as far as it may matter."""
        head = node.parent.start_byte if node.parent is not None else -1
        relevance = Relevance(self._lowered.source, node.start_byte, node.end_byte, test, head)
        self.in_part = in_part = relevance.level is not Level.WHOLE
        if in_part:
            self._lowered.left_out += (node.start_byte, node.end_byte)
        if relevance.level is Level.NOTHING:
            self.sets = relevance.sets
            return ()
        before = self._relevance, self._whole, self._leaves
        self._relevance, self._whole, self._leaves = relevance, relevance.level is Level.WHOLE, frozenset()
        try:
            return self.block(node)
        finally:
            self._relevance, self._whole, self._leaves = before
            self.sets, self.in_part = relevance.sets, in_part

    def _may_lead(self, node: Node) -> bool:
        return self._whole or self._relevance is None or self._relevance.may_lead(node.start_byte, node.end_byte)

    def block(self, node: Node | None) -> tuple[Statement, ...]:
        """Return the statements of a block, or of the one statement in its place."""
        out: Statements = []
        if node is not None:
            self.add(node.named_children if node.type in _BLOCKS else (node,), out)
        return tuple(out)

    def add(self, nodes: Iterable[Node], out: Statements) -> None:
        """Add the lowering of ``nodes`` to ``out``."""
        for node in nodes:
            kind = node.type
            handler = _HANDLERS.get(kind)
            if handler is not None:
                handler(self, node, out)
            elif kind not in _SILENT and not self.on_definition(node, out):
                self._evaluate(node, node, out)

    def _nested(self, node: Node, out: Statements) -> None:
        """Add the lowering of a nested block, or of the rest of what does not parse."""
        if not self._lowered.too_deep(node):
            self._lowered.depth += 1
            self.add(node.named_children, out)
            self._lowered.depth -= 1

    def _labeled(self, node: Node, out: Statements) -> None:
        self.add([child for child in node.named_children if child.type != "statement_identifier"], out)

    def _expression(self, node: Node, out: Statements) -> None:
        source, start, end = self._lowered.source, node.start_byte, node.end_byte
        relevance = self._relevance
        if not self._whole and relevance is not None and not relevance.may_lead(start, end):
            return
        for inner in node.named_children:
            kind = inner.type
            if kind == "assignment_expression":
                if not is_filling(source, start, end):
                    self._assign(inner, out)
            elif kind == "update_expression":
                out += self._counted(inner)
            elif kind != "comment" and not is_logging(source, start, end):
                self._evaluate(inner, node, out)

    def _counted(self, node: Node) -> Statements:
        """Return ``++i``, ``i--`` as assignments."""
        counter, operator = node.child_by_field_name("argument"), node.child_by_field_name("operator")
        if counter is None or operator is None:
            return []
        target = self._lower(counter)
        value = Operation(operator.type[:1], (target, Literal(1)))
        return [Assign(target, value, "", "=", node.start_point.row + 1)]

    def _leave(self, node: Node, out: Statements) -> None:
        if node.type in self._leaves:
            out.append(Leave(node.type == "continue_statement", node.start_point.row + 1))

    def _evaluate(self, inner: Node, node: Node, out: Statements) -> None:
        text = self._lowered.text(inner)
        if b"(" in text or b"<<" in text or b"{" in text:
            expression = self._lower(inner)
            match expression:
                case Call() if (made := owned(expression, inner)) is not None:
                    out.append(Assign(made[0], made[1], "", "=", node.start_point.row + 1))
                case Call() | Operation() | Format():
                    out.append(Evaluate(expression, node.start_point.row + 1))

    def _assign(self, node: Node, out: Statements) -> None:
        children = node.children
        if len(children) != 3:
            children = [child for child in children if child.type != "comment"]
        if len(children) != 3:
            return
        left, operator, right = children
        if right.type == "assignment_expression" and not self._lowered.too_deep(node):
            self._lowered.depth += 1
            self._assign(right, out)
            self._lowered.depth -= 1
            right = right.child_by_field_name("left") or right
        target, value = self._lower(left), self._lower(right)
        sign = operator.type
        if sign not in ("=", "+="):
            value, sign = Operation(sign[:-1], (target, value)), "="
        out.append(Assign(target, value, "", sign, node.start_point.row + 1))

    def _declaration(self, node: Node, out: Statements) -> None:
        if self._may_lead(node):
            self.declare(node, out)

    def declare(self, node: Node, out: Statements, prefix: str | None = None) -> None:
        """Add the lowering of a declaration of variables; ``prefix`` is the scope with its dot, None of local ones."""
        self._variables.declare(node, out, self.on_definition, prefix)

    def _return(self, node: Node, out: Statements) -> None:
        values = [child for child in node.named_children if child.type != "comment"]
        value = None
        if values:
            first = values[0]
            plain = first.end_byte - first.start_byte < _SHORT_VALUE or self._may_lead(first)
            value = self._lower(first) if plain else opaque(self._lowered.text(first))
        out.append(Return(value, node.start_point.row + 1))

    def _throw(self, node: Node, out: Statements) -> None:
        if self._whole:
            values = self._expressions.several(node)
            row, column = node.start_point
            out.append(Evaluate(Call(Name("throw"), values, (), (), row + 1, column + 1), row + 1))

    def _yield(self, node: Node, out: Statements) -> None:
        for child in node.named_children:
            self._evaluate(child, node, out)

    def _left_out(self, node: Node) -> bool:
        if self._lowered.too_deep(node):
            return True
        relevance = self._relevance
        return not self._whole and relevance is not None and not relevance.may_hold(node.start_byte, node.end_byte)

    def _condition(self, node: Node | None, out: Statements) -> Expression:
        """Return a condition; what it declares is added to ``out`` before."""
        if node is None:
            return Opaque("")
        if node.type == "condition_clause":
            first, value = node.child_by_field_name("initializer"), node.child_by_field_name("value")
            if first is not None:
                self.add(first.named_children if first.type == "init_statement" else (first,), out)
            return self._condition(value, out) if value is not None else opaque(self._lowered.text(node))
        if node.type == "declaration":
            self.declare(node, out)
            declarator = node.child_by_field_name("declarator")
            return name_of(declared_name(self._lowered.text(declarator))) if declarator is not None else Opaque("")
        return self._lower(node) if self._may_lead(node) else opaque(self._lowered.text(node))

    def _if(self, node: Node, out: Statements) -> None:
        if self._left_out(node):
            return
        self._lowered.depth += 1
        arms: list[_Arm] = []
        current: Node | None = node
        while current is not None and current.type == "if_statement":
            first: Statements = []
            condition = self._condition(current.child_by_field_name("condition"), first)
            then = self.block(current.child_by_field_name("consequence"))
            arms.append((first, condition, then, current.start_point.row + 1))
            clause = current.child_by_field_name("alternative")
            current = None
            if clause is not None:
                inner = [child for child in clause.named_children if child.type != "comment"]
                current = inner[0] if inner else None
        self._chain(arms, self.block(current), node, out)
        self._lowered.depth -= 1

    def _chain(self, arms: list[_Arm], otherwise: tuple[Statement, ...], node: Node, out: Statements) -> None:
        """Add branches of which each stands in the one before; of more than some hundred the rest stands behind."""
        if len(arms) > DEEPEST:
            self._lowered.incomplete.add((node.start_point.row + 1, f"more than {DEEPEST} alternatives"))
        starts = range(0, len(arms), DEEPEST)
        for start in starts:
            chained = otherwise if start == starts[-1] else ()
            for first, condition, then, line in reversed(arms[start : start + DEEPEST]):
                if then or chained or not says_nothing(condition):
                    chained = (*first, Branch(condition, then, chained, line))
                else:
                    chained = tuple(first)
            out += chained
        if not arms:
            out += otherwise

    def _switch(self, node: Node, out: Statements) -> None:
        if self._left_out(node):
            return
        self._lowered.depth += 1
        # What ``break`` leaves here is the choice.
        around, self._leaves = self._leaves, self._leaves | {"break_statement"}
        subject = self._condition(node.child_by_field_name("condition"), out)
        cases = fallen_through(self._cases(node.child_by_field_name("body"), subject), self._lowered)
        otherwise = next((then for condition, then, _ in cases if condition is None), ())
        arms: list[_Arm] = [([], condition, then, line) for condition, then, line in cases if condition is not None]
        self._chain(arms, otherwise, node, out)
        self._leaves = around
        self._lowered.depth -= 1

    def _cases(self, body: Node | None, subject: Expression) -> list[Case]:
        """Return the cases of a choice; labels without statements belong to the case behind them."""
        found: list[Case] = []
        labels: list[Expression] = []
        default = False
        for case in body.named_children if body is not None else ():
            if case.type != "case_statement":
                continue
            value = case.child_by_field_name("value")
            statements: Statements = []
            start = value.end_byte if value is not None else -1
            inner = [child for child in case.named_children if child.start_byte >= start]
            self.add(inner, statements)
            default = default or value is None
            if value is not None:
                labels.append(Operation("==", (subject, self._lower(value))))
            if inner:
                condition = None if default else any_label(labels)
                found.append((condition, statements, ends_case(inner), case.start_point.row + 1))
                labels, default = [], False
        return found

    def _loop(self, node: Node, out: Statements) -> None:
        if self._left_out(node):
            return
        self._lowered.depth += 1
        first = node.child_by_field_name("initializer")
        if first is not None:
            self.add((first,), out)
        condition = node.child_by_field_name("condition")
        over = self._condition(condition, out) if condition is not None else None
        body: Statements = [*self._turn(node)]
        if node.type == "do_statement":
            if isinstance(over, Call | Operation):
                body.append(Evaluate(over, node.start_point.row + 1))
            over = None
        update: Statements = []
        after = node.child_by_field_name("update")
        if after is not None and after.type == "update_expression":
            update = self._counted(after)
        elif after is not None and after.type == "assignment_expression":
            self._assign(after, update)
        elif after is not None and b"(" in self._lowered.text(after):
            self._evaluate(after, after, update)
        if body or any(isinstance(one, Evaluate) for one in update) or not says_nothing(over):
            out.append(Loop(None, over, tuple(body), node.start_point.row + 1, tuple(update)))
        self._lowered.depth -= 1

    def _turn(self, node: Node) -> tuple[Statement, ...]:
        """Return what one turn of a loop does."""
        around, self._leaves = self._leaves, _LEAVES
        found = self.block(node.child_by_field_name("body"))
        self._leaves = around
        return found

    def _range(self, node: Node, out: Statements) -> None:
        if self._left_out(node):
            return
        self._lowered.depth += 1
        declarator, over = node.child_by_field_name("declarator"), node.child_by_field_name("right")
        first = node.child_by_field_name("initializer")
        if first is not None:
            self.add(first.named_children if first.type == "init_statement" else (first,), out)
        target = target_of(self._lowered.text(declarator)) if declarator is not None else None
        sequence = self._lower(over) if over is not None else None
        body = self._turn(node)
        if body or not says_nothing(sequence):
            out.append(Loop(target or Opaque(""), sequence, body, node.start_point.row + 1))
        self._lowered.depth -= 1

    def _try(self, node: Node, out: Statements) -> None:
        if self._left_out(node):
            return
        self._lowered.depth += 1
        then = self.block(node.child_by_field_name("body"))
        line = node.start_point.row + 1
        out.append(Branch(NO_EXCEPTION, then, self.handlers(node), line))
        self._lowered.depth -= 1

    def handlers(self, node: Node) -> tuple[Statement, ...]:
        """Return what the handlers of ``try`` do; each after the first is what else may happen."""
        otherwise: tuple[Statement, ...] = ()
        clauses = [child for child in node.named_children if child.type == "catch_clause"]
        for number, clause in reversed(list(enumerate(clauses))):
            body = self.block(clause.child_by_field_name("body"))
            if number == len(clauses) - 1:
                otherwise = body
            elif body or otherwise:
                caught = clause.child_by_field_name("parameters")
                written = self._lowered.text(caught) if caught is not None else b""
                condition = opaque(b"catch " + written)
                otherwise = (Branch(condition, body, otherwise, clause.start_point.row + 1),)
        return otherwise


_SHORT_VALUE = 40
_LEAVES = frozenset({"break_statement", "continue_statement"})
"""A branch or loop that holds nothing is left out with such a condition."""
_BLOCKS = ("compound_statement", "translation_unit")
_SILENT_WORDS = (
    "comment goto_statement static_assert_declaration empty_statement identifier "
    "attribute_declaration gnu_asm_expression parameter_list number_literal string_literal"
)
_SILENT = frozenset(_SILENT_WORDS.split())
_KINDS = {
    "nested": "compound_statement ERROR attributed_statement else_clause init_statement case_statement",
    "labeled": "labeled_statement",
    "expression": "expression_statement",
    "assign": "assignment_expression",
    "declaration": "declaration",
    "return": "return_statement co_return_statement",
    "throw": "throw_statement",
    "yield": "co_yield_statement",
    "if": "if_statement",
    "switch": "switch_statement",
    "loop": "for_statement while_statement do_statement",
    "range": "for_range_loop",
    "try": "try_statement",
    "leave": "break_statement continue_statement",
}
_HANDLERS: dict[str, Callable[[StatementLowering, Node, Statements], None]] = {
    kind: getattr(StatementLowering, f"_{method}") for method, kinds in _KINDS.items() for kind in kinds.split()
}
"""Kind of a node to the method that lowers it."""
