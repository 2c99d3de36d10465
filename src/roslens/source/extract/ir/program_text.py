"""A program of :mod:`~roslens.source.extract.ir.program` as text that is short enough to be written and read by hand.

::

    import fs = boost::filesystem
    class ns.Talker(rclcpp.Node)
      rate_: int = 3
    function ns.Talker.Talker(name: const std::string & = "x") of ns.Talker
      init rclcpp.Node("talker")
      self->pub_ = create_publisher<T>((name + "/out"), 1)
      if use_:
        return
    function#1 ns.Talker.Talker.lambda(m: T)
    declared ns.f(rate: double = 10.0)
    body
      ns.TOPIC: const char * = "chatter"

A member of an object is ``of->name`` in both languages, as a dot belongs to names. ``function#1`` is the one that
``lambda#1`` means. Text that is opaque stands between backquotes, the parts of a format in ``format[…]``.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from roslens.source.extract.ir.program import (
    Assign,
    Branch,
    Call,
    Class,
    Evaluate,
    Expression,
    Field,
    Format,
    Function,
    Item,
    Lambda,
    Leave,
    Literal,
    Loop,
    Mapping,
    Member,
    Name,
    Opaque,
    Operation,
    Parameter,
    Program,
    Return,
    Sequence,
    Statement,
)


def program_text(program: Program, *, lines: bool = False) -> str:
    """Return ``program`` as text.

    Args:
        program: what to write.
        lines: whether calls end with ``@line:column`` and the rest with ``@line``.
    """
    return "".join(f"{line}\n" for line in _Writer(lines).program(program))


def expression_text(expression: Expression) -> str:
    """Return ``expression`` as text, without positions."""
    return _Writer(lines=False).expression(expression)


class _Writer:
    def __init__(self, lines: bool) -> None:
        self._lines = lines

    def program(self, program: Program) -> Iterator[str]:
        for header, line in program.includes:
            yield f"include {header}{self._at(line)}"
        for scope in program.using:
            yield f"using {scope}"
        for name, meaning in program.imports.items():
            yield f"import {name} = {meaning}"
        for name, value in program.macros.items():
            yield f"macro {name} = {self.expression(value)}"
        for one in program.classes:
            yield from self._class(one)
        for number, function in enumerate(program.functions):
            yield from self._function(function, number)
        for declared in program.declarations:
            yield f"declared {self._header(declared)}"
        if program.body:
            yield "body"
            yield from _indented(self._block(program.body))
        for line, reason in program.incomplete:
            yield f"incomplete {line}: {reason}"

    def _at(self, line: int) -> str:
        return f" @{line}" if self._lines else ""

    def _class(self, one: Class) -> Iterator[str]:
        bases = f"({', '.join(one.bases)})" if one.bases else ""
        yield f"class {one.qualified_name}{_angles(one.templates)}{bases}{self._at(one.line)}"
        for field in one.fields:
            yield f"  {self._field(field)}"

    def _field(self, field: Field) -> str:
        return f"{field.name}{self._typed(field.type, field.value)}{self._at(field.line)}"

    def _typed(self, type_: str, value: Expression | None) -> str:
        return (f": {type_}" if type_ else "") + (f" = {self.expression(value)}" if value is not None else "")

    def _function(self, function: Function, number: int) -> Iterator[str]:
        for decorator in function.decorators:
            yield f"@{self.expression(decorator)}"
        word = f"function#{number}" if function.name == "lambda" else "function"
        yield f"{word} {self._header(function)}"
        for line in self._block(function.initialisers):
            yield f"  init {line}"
        yield from _indented(self._block(function.body))

    def _header(self, function: Function) -> str:
        parameters = ", ".join(map(self._parameter, function.parameters))
        owner = f" of {function.class_name}" if function.class_name else ""
        return f"{function.qualified_name}{_angles(function.templates)}({parameters}){owner}{self._at(function.line)}"

    def _parameter(self, parameter: Parameter) -> str:
        return f"{parameter.name}{self._typed(parameter.type, parameter.default)}"

    def _block(self, statements: Iterable[Statement]) -> Iterator[str]:
        for statement in statements:
            yield from self._statement(statement)

    def _statement(self, statement: Statement) -> Iterator[str]:
        at = self._at(statement.line)
        match statement:
            case Assign():
                target = self.expression(statement.target) + (f": {statement.declared}" if statement.declared else "")
                sign = "+=" if statement.operator == "+=" else "="
                value = "" if statement.value is None else f" {sign} {self.expression(statement.value)}"
                yield f"{target}{value}{at}"
            case Evaluate():
                yield f"{self.expression(statement.expression)}{at}"
            case Return():
                value = "" if statement.value is None else f" {self.expression(statement.value)}"
                yield f"return{value}{at}"
            case Branch():
                yield f"if {self.expression(statement.condition)}:{at}"
                yield from _indented(self._block(statement.then))
                if statement.otherwise:
                    yield "else:"
                    yield from _indented(self._block(statement.otherwise))
            case Leave():
                yield f"{'continue' if statement.again else 'break'}{at}"
            case _:
                yield f"{self._loop(statement)}:{at}"
                yield from _indented(self._block(statement.body))
                if statement.update:
                    yield "then:"
                    yield from _indented(self._block(statement.update))

    def _loop(self, loop: Loop) -> str:
        over = "" if loop.over is None else self.expression(loop.over)
        if loop.target is not None:
            return f"for {self.expression(loop.target)} in {over}"
        return f"while {over}" if over else "loop"

    def expression(self, expression: Expression) -> str:
        return _WRITTEN[type(expression)](self, expression)

    def literal(self, literal: Literal) -> str:
        return json.dumps(literal.value, ensure_ascii=False)

    def member(self, member: Member) -> str:
        return f"{self.expression(member.of)}->{member.name}"

    def item(self, item: Item) -> str:
        return f"{self.expression(item.of)}[{self.expression(item.key)}]"

    def mapping(self, mapping: Mapping) -> str:
        pairs = [f"{self.expression(key)}: {self.expression(value)}" for key, value in mapping.items]
        return f"{{{', '.join(pairs)}}}"

    def format(self, format_: Format) -> str:
        return f"format[{self._listed(format_.parts)}]"

    def sequence(self, sequence: Sequence) -> str:
        return f"[{self._listed(sequence.items)}]"

    def _listed(self, expressions: Iterable[Expression]) -> str:
        return ", ".join(map(self.expression, expressions))

    def call(self, call: Call) -> str:
        arguments = [self.expression(argument) for argument in call.arguments]
        arguments += [f"{name}={self.expression(value)}" for name, value in call.keywords]
        at = f"@{call.line}:{call.column}" if self._lines else ""
        return f"{self.expression(call.function)}{_angles(call.templates)}({', '.join(arguments)}){at}"

    def operation(self, operation: Operation) -> str:
        operands = [self.expression(operand) for operand in operation.operands]
        if operation.operator == "?:" and len(operands) == 3:
            return f"({operands[0]} ? {operands[1]} : {operands[2]})"
        if len(operands) == 1:
            return f"({operation.operator} {operands[0]})"
        return f"({f' {operation.operator} '.join(operands)})"


def _angles(names: tuple[str, ...]) -> str:
    return f"<{', '.join(names)}>" if names else ""


def _indented(lines: Iterable[str]) -> Iterator[str]:
    return (f"  {line}" for line in lines)


_WRITTEN: dict[type[Any], Callable[[_Writer, Any], str]] = {
    Literal: _Writer.literal,
    Name: lambda _, name: str(name.name),
    Member: _Writer.member,
    Item: _Writer.item,
    Call: _Writer.call,
    Operation: _Writer.operation,
    Mapping: _Writer.mapping,
    Lambda: lambda _, one: f"lambda#{one.function}",
    Opaque: lambda _, one: f"`{one.text}`",
    Format: _Writer.format,
    Sequence: _Writer.sequence,
}
