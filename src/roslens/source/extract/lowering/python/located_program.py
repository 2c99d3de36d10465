"""A Python file as a program with more information than stored ones.

It knows where each of its expressions stands, and what is spread out in a list: ``[*first, last]`` has the operation
``*`` of ``first``. Tables are joined by ``|``, and a generator is a function that returns the list of what it yields.
"""

from __future__ import annotations

import msgspec
from tree_sitter import Node

from roslens.source.extract.ir.program import (
    NO_EXCEPTION,
    Assign,
    Branch,
    Call,
    Expression,
    Literal,
    Member,
    Name,
    Operation,
    Program,
    Return,
    Sequence,
    Statement,
)
from roslens.source.extract.lowering.python.python_program import lower_python
from roslens.source.extract.lowering.python.python_program_statements import Statements
from roslens.source.syntax.python_tree import parse_tree, with_line_feeds

MOST_LENGTH = 2_000
"""Characters of an expression that are kept."""


class Written(msgspec.Struct, frozen=True):
    """Where an expression stands, from 1 on, and how it begins."""

    line: int
    column: int
    text: str


class Places:
    """Where the expressions of programs stand."""

    def __init__(self) -> None:
        """Begin without any."""
        # By identity: two expressions may be equal. What is kept beside it keeps the number from being given again.
        self._found: dict[int, tuple[Expression, Written]] = {}

    def keep(self, expression: Expression, place: Written) -> None:
        """Keep where an expression stands."""
        self._found[id(expression)] = (expression, place)

    def take(self, places: Places) -> None:
        """Take over where the expressions of other programs stand."""
        self._found |= places._found

    def of(self, expression: Expression) -> Written | None:
        """Return where an expression stands; None where it was made while the program was."""
        found = self._found.get(id(expression))
        return None if found is None else found[1]


_YIELDED = Name("#yielded")
"""The list of what a generator yields: it is evaluated as a function that returns them all."""


class _Located(Statements):
    operators = Statements.operators | {"|"}

    def __init__(self, source: bytes, places: Places, *, handlers: bool) -> None:
        super().__init__(source)
        self._places = places
        self._handlers = handlers
        self._listing = False
        self._yields = False

    def expression(self, node: Node) -> Expression:
        # What is written twice is two expressions here.
        self._known = {}
        found = super().expression(node)
        if self._places.of(found) is None:  # else it is the same in brackets
            line, start = self.line(node), node.start_byte
            text = self.source[start : min(node.end_byte, start + MOST_LENGTH)].decode("utf-8", "replace")
            self._places.keep(found, Written(line, start - self._starts[line - 1] + 1, text))
        return found

    def _sequence(self, node: Node) -> Expression:
        outer, self._listing = self._listing, True
        found = super()._sequence(node)
        self._listing = outer
        return found

    def _call(self, node: Node) -> Expression:
        outer, self._listing = self._listing, False
        found = super()._call(node)
        self._listing = outer
        return found

    def _item(self, node: Node) -> Expression:
        if not self._listing or not self._starred(node):
            return super()._item(node)
        return Operation("*", (self.expression(node.children[-1] if node.type == "list_splat" else node),))

    def _yielded(self, node: Node) -> Expression:
        """Return the call that adds a value to the list of those that a generator yields."""
        self._yields = True
        values = self.parts(node)
        several = any(child.type == "from" for child in node.children)
        given = self.expression(values[0]) if values else Literal(None)
        line, start = self.line(node), node.start_byte
        return Call(Member(_YIELDED, "extend" if several else "append"), (given,), line=line,
                    column=start - self._starts[line - 1] + 1)  # fmt: skip

    def _on_function(self, node: Node) -> None:
        outer, self._yields = self._yields, False
        index = len(self.functions)
        super()._on_function(node)
        found = self.functions[index]
        if self._yields and found is not None:
            body = (Assign(_YIELDED, Sequence(()), line=found.line), *found.body, Return(_YIELDED, found.line))
            self.functions[index] = msgspec.structs.replace(found, body=body)
        self._yields = outer

    def _on_try(self, node: Node) -> None:
        super()._on_try(node)
        if not self._handlers:
            self.pending = [inner for one in self.pending for inner in _tried(one)]


def _tried(statement: Statement) -> tuple[Statement, ...]:
    """Return what a block comes to of which it is taken that it runs to its end."""
    match statement:
        case Branch() if statement.condition == NO_EXCEPTION:
            return statement.then
    return (statement,)


def located_program(content: bytes, places: Places | None = None, *, handlers: bool = True) -> tuple[Program, Places]:
    """Return the program of a Python file, and where its expressions stand; never fails.

    Args:
        content: of the file.
        places: where those of other files stand, which are kept.
        handlers: whether what handles exceptions is a part of it.
    """
    parsed = parse_tree(with_line_feeds(content))
    places = places or Places()
    return lower_python(parsed, _Located(parsed.source, places, handlers=handlers)), places
