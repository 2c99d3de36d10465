"""Control structure of Python, lowered: branches, loops, what may raise, ``match``."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.extract.ir.program import (
    NO_BREAK,
    NO_EXCEPTION,
    Assign,
    Branch,
    Call,
    Expression,
    Item,
    Leave,
    Loop,
    Member,
    Name,
    Opaque,
    Statement,
)
from roslens.source.extract.lowering.python.python_program_patterns import Patterns
from roslens.source.extract.lowering.python.python_program_reading import DEEPEST
from roslens.source.syntax.python_tree import LANGUAGE

_ARMS = frozenset({"except_clause", "except_group_clause"})
_BLOCK = LANGUAGE.id_for_node_kind("block", True) or 0
_Handler = tuple[str, tuple[Statement, ...]]
"""How an exception is caught, as it is written, and what is done then."""


class Control(Patterns):
    """Lowers the statements of one file that hold others."""

    def block(self, node: Node | None) -> tuple[Statement, ...]:
        """Return the statements of a block; none of None."""
        if node is None:
            return ()
        outer, self.pending = self.pending, []
        self.statements(node)
        inner, self.pending = self.pending, outer
        return tuple(inner)

    def statements(self, node: Node) -> None:
        """Append the statements that stand in a node."""
        for child in node.children:
            if child.is_named:
                self.evaluate(child)

    def _on_if(self, node: Node) -> None:
        depth, calls = self._depth, self._calls
        condition = self._condition(node)
        then = self.block(node.child_by_field_name("consequence"))
        arms = [child for child in node.children if child.type in {"elif_clause", "else_clause"}]
        otherwise = self._arms(arms)
        if then or otherwise or self._calls > calls:
            self.pending.append(Branch(condition, then, otherwise, self.line(node)))
        self._depth = depth

    def _condition(self, node: Node) -> Expression:
        condition = node.child_by_field_name("condition")
        return self.expression(condition) if condition is not None else Opaque("")

    def _arms(self, arms: list[Node]) -> tuple[Statement, ...]:
        """Return the ``elif`` and ``else`` of a branch, each inside the one before."""
        found: list[tuple[list[Statement], Expression, tuple[Statement, ...], int]] = []
        last: tuple[Statement, ...] = ()
        outer = self.pending
        for arm in arms:
            if self._depth >= DEEPEST:
                self._too_deep(arm)
                break
            self._depth += 1
            if arm.type == "else_clause":
                last = (*last, *self.block(arm.child_by_field_name("body")))
                continue
            self.pending = []
            condition = self._condition(arm)
            made = self.pending
            found.append((made, condition, self.block(arm.child_by_field_name("consequence")), self.line(arm)))
        self.pending = outer
        for made, condition, then, line in reversed(found):
            last = (*made, Branch(condition, then, last, line))
        return last

    def _on_for(self, node: Node) -> None:
        right, left = node.child_by_field_name("right"), node.child_by_field_name("left")
        over = self.expression(right) if right is not None else Opaque("")
        target = self.expression(left) if left is not None else Opaque("")
        body = self.block(node.child_by_field_name("body"))
        self.pending.append(Loop(target, over, body, self.line(node)))
        self._rest(node, body)

    def _on_while(self, node: Node) -> None:
        condition = self._condition(node)
        body = self.block(node.child_by_field_name("body"))
        self.pending.append(Loop(None, condition, body, self.line(node)))
        self._rest(node, body)

    def _rest(self, node: Node, body: tuple[Statement, ...]) -> None:
        """Append what stands behind ``else``: where the loop may be left, under the condition that it was not."""
        rest = node.child_by_field_name("alternative")
        if rest is None:
            return
        found = self.block(rest.child_by_field_name("body"))
        self.pending += (Branch(NO_BREAK, found, (), self.line(rest)),) if found and _breaks(body) else found

    def _on_try(self, node: Node) -> None:
        depth, then = self._depth, self.block(node.child_by_field_name("body"))
        handlers: list[_Handler] = []
        last: tuple[Statement, ...] = ()
        for child in node.children:
            kind = child.type
            if kind == "else_clause":
                then += self.block(child.child_by_field_name("body"))
            elif kind == "finally_clause":
                last = self.block(self._last_block(child))
            elif kind not in _ARMS:
                continue
            elif self._depth >= DEEPEST:
                self._too_deep(child)
            else:
                self._depth += 1
                handlers.append(self._handler(child))
        self._depth = depth
        otherwise = self._handled(handlers, self.line(node))
        if then or otherwise:
            self.pending.append(Branch(NO_EXCEPTION, then, otherwise, self.line(node)))
        self.pending += last

    def _handler(self, node: Node) -> _Handler:
        block = self._last_block(node)
        head = self.source[node.start_byte : block.start_byte if block is not None else node.end_byte]
        caught = b" ".join(head.split()).decode("utf-8", "backslashreplace").rstrip(" :")[:80]
        return caught, self.block(block)

    def _last_block(self, clause: Node) -> Node | None:
        """Return the block of a clause that has no field for it."""
        parts = self.parts(clause)
        return parts[-1] if parts and parts[-1].kind_id == _BLOCK else None

    def _handled(self, handlers: list[_Handler], line: int) -> tuple[Statement, ...]:
        otherwise: tuple[Statement, ...] = ()
        for number, (caught, body) in enumerate(reversed(handlers)):
            otherwise = body if number == 0 else (Branch(Opaque(caught), body, otherwise, line),)
        return otherwise

    def _on_with(self, node: Node) -> None:
        for clause in self.parts(node):
            if clause.type != "with_clause":
                continue
            for item in self.parts(clause):
                value = item.child_by_field_name("value")
                if value is not None:
                    self.evaluate(value)
        body = node.child_by_field_name("body")
        if body is not None:
            self.statements(body)

    def _on_match(self, node: Node) -> None:
        subjects = tuple(self._subject(one, node) for one in node.children_by_field_name("subject"))
        body = node.child_by_field_name("body")
        if body is None:
            return
        found: list[tuple[list[Statement], Expression | None, tuple[Statement, ...], int]] = []
        outer, depth = self.pending, self._depth
        for case in self.parts(body):
            if self._depth >= DEEPEST:
                self._too_deep(case)
                break
            self._depth += 1
            self.pending = []
            condition = self.case(case, subjects)
            made = self.pending
            found.append((made, condition, self.block(case.child_by_field_name("consequence")), self.line(case)))
        self.pending, self._depth = outer, depth
        rest: tuple[Statement, ...] = ()
        for made, condition, then, line in reversed(found):
            rest = (*made, *then) if condition is None else (*made, Branch(condition, then, rest, line))
        self.pending += rest

    def _subject(self, subject: Node, of: Node) -> Expression:
        """Return what cases are compared with: a call is made once, also one of which an element or member is taken."""
        found = self.expression(subject)
        inner = found
        while isinstance(inner, Item | Member):
            inner = inner.of
        if not isinstance(inner, Call):
            return found
        self._made += 1
        kept = Name(f"#{self._made}")
        self.pending.append(Assign(kept, found, line=self.line(of)))
        return kept


def _breaks(body: tuple[Statement, ...]) -> bool:
    """Whether a loop with such a body may be left before it has ended."""
    for one in body:
        match one:
            case Leave() if not one.again:
                return True
            case Branch() if _breaks(one.then) or _breaks(one.otherwise):
                return True
    return False
