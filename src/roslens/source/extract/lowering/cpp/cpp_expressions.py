"""Expressions of C++ as those of a program.

What holds no call is lowered once for all places that say the same; only calls know where they are. An operator
that stands several times in a row (``a + b + c``) is one :class:`Operation`. Casts vanish, and so do ``&x`` and ``*x``.
An expression that says nothing about the graph but holds calls is a ``,`` operation: its calls, then its text.
``500ms`` is a call of ``ms``, an assignment inside an expression an ``=`` operation.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import lru_cache
from typing import TypeGuard

from tree_sitter import Node

from roslens.source.extract.ir.program import (
    Call,
    Expression,
    Format,
    Item,
    Literal,
    Member,
    Name,
    Opaque,
    Operation,
    Sequence,
)
from roslens.source.extract.lowering.cpp.cpp_literals import number_value, text_value
from roslens.source.extract.lowering.cpp.cpp_lowered import DEEPEST, Lowered, name_of, opaque
from roslens.source.extract.lowering.cpp.cpp_types import declared_type, is_primitive, name_and_templates
from roslens.source.syntax.cpp_names import text_of

_CONTAINERS = frozenset(
    f"std.{name}"
    for name in ("vector", "array", "list", "deque", "set", "unordered_set", "map", "unordered_map", "initializer_list")
)
_OPERATORS = {"&&": "and", "||": "or"}
_CHAINED = frozenset({"+", "<<", "&&", "||", "and", "or"})
_TEXT_SUFFIXES = frozenset({"s", "sv"})
_PLACEHOLDER = re.compile(r"\{\{|\}\}|\{(\d*)(:[^{}]*)?\}")
_SIMPLE = (Name, Literal, Opaque)


class Expressions:
    """Lowers expressions.

    Attributes:
        on_lambda: what lowers a lambda; set by who lowers statements.
    """

    on_lambda: Callable[[Node], Expression]

    def __init__(self, lowered: Lowered) -> None:
        """Lower for ``lowered``."""
        self._lowered = lowered
        self._source = lowered.source
        self._known: dict[bytes, Expression] = {}

    def lower(self, node: Node) -> Expression:
        """Return the expression of ``node``."""
        text = self._source[node.start_byte : node.end_byte]
        if b"(" in text:
            return self._lower(node)
        known = self._known.get(text)
        if known is None:
            if node.type == "identifier" and self._lowered.depth < DEEPEST:
                known = self._known[text] = _named(text)
                return known
            known = self._lower(node)
            if b"{" not in text and b"new" not in text:
                self._known[text] = known
        return known

    def _lower(self, node: Node) -> Expression:
        kind = node.type
        while kind == "parenthesized_expression" and node.named_child_count == 1:
            node = node.named_children[0]
            kind = node.type
        lowered = self._lowered
        if lowered.depth >= DEEPEST and lowered.too_deep(node):
            return opaque(lowered.text(node))
        lowered.depth += 1
        handler = _HANDLERS.get(kind)
        found = self._other(node) if handler is None else handler(self, node)
        lowered.depth -= 1
        return found

    def several(self, node: Node) -> tuple[Expression, ...]:
        """Return the expressions in a list of arguments or of initial values."""
        if not node.named_child_count:
            return ()
        return tuple([self.lower(child) for child in node.named_children if child.type != "comment"])

    def construct(self, type_: bytes, values: Node, at: Node) -> Expression:
        """Return what ``type_ name(values)``, ``type_{values}`` or ``type_(values)`` makes."""
        arguments = self.several(values)
        name, templates = name_and_templates(type_)
        if is_primitive(type_) and len(arguments) < 2:
            return arguments[0] if arguments else Literal(False if name == "bool" else 0)
        if not declared_type(type_) and len(arguments) == 1:
            return arguments[0]
        if name in _CONTAINERS and values.type == "initializer_list":
            if name != "std.vector" or not templates:
                return Sequence(arguments)
            arguments = (Sequence(arguments),)
        row, column = at.start_point
        return Call(name_of(name), arguments, (), templates, row + 1, column + 1)

    def _name(self, node: Node) -> Expression:
        return _named(self._source[node.start_byte : node.end_byte])

    def _member(self, node: Node) -> Expression:
        children = [child for child in node.named_children if child.type != "comment"]
        if len(children) < 2:
            return self._other(node)
        return Member(self.lower(children[0]), name_and_templates(self._lowered.text(children[-1]))[0])

    def _item(self, node: Node) -> Expression:
        of, *keys = [child for child in node.named_children if child.type != "comment"]
        if len(keys) != 1:
            return self._other(node)
        key = keys[0]
        if key.type == "subscript_argument_list":
            values = self.several(key)
            return Item(self.lower(of), values[0] if len(values) == 1 else Sequence(values))
        return Item(self.lower(of), self.lower(key))

    def _call(self, node: Node) -> Expression:
        children = node.named_children
        function, arguments = children[0], children[-1]
        if arguments.type not in ("argument_list", "initializer_list") or len(children) < 2:
            return self._other(node)
        kind = function.type
        if kind == "primitive_type" or kind == "sized_type_specifier":
            return self.construct(self._lowered.text(function), arguments, node)
        values = self.several(arguments)
        templates: tuple[str, ...] = ()
        if kind == "identifier":
            callee: Expression = self.lower(function)
        elif kind == "field_expression":
            callee, templates = self._method(function)
        elif kind in ("qualified_identifier", "template_function"):
            name, templates = name_and_templates(self._lowered.text(function))
            instead = _INSTEAD[name](values) if name in _INSTEAD else None
            if instead is not None:
                return instead
            callee = name_of(name)
            if not values and name == "std.vector":
                # What stands there is empty; a variable that is declared may be filled.
                values = (Sequence(()),)
        else:
            callee = self.lower(function)
        row, column = node.start_point
        return Call(callee, values, (), templates, row + 1, column + 1)

    def _method(self, node: Node) -> tuple[Expression, tuple[str, ...]]:
        children = node.named_children
        of, field = children[0], children[-1]
        if len(children) < 2:
            return self._other(node), ()
        name, templates = name_and_templates(self._lowered.text(field))
        return Member(self.lower(of), name), templates

    def _binary(self, node: Node) -> Expression:
        operator = _operator(node)
        right, left = node.child_by_field_name("right"), node.child_by_field_name("left")
        operands = []
        while right is not None and left is not None:
            operands.append(self.lower(right))
            if operator not in _CHAINED or left.type != "binary_expression" or _operator(left) != operator:
                operands.append(self.lower(left))
                break
            right, left = left.child_by_field_name("right"), left.child_by_field_name("left")
        return Operation(_OPERATORS.get(operator, operator), tuple(reversed(operands)))

    def _unary(self, node: Node) -> Expression:
        operator, argument = _operator(node), node.child_by_field_name("argument")
        if argument is None:
            return self._other(node)
        value = self.lower(argument)
        if operator in ("-", "+") and isinstance(value, Literal) and isinstance(value.value, int | float):
            return Literal(-value.value if operator == "-" else value.value)
        return Operation("not" if operator == "!" else operator, (value,))

    def _assignment(self, node: Node) -> Expression:
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        if left is None or right is None:
            return self._other(node)
        return Operation(_operator(node) or "=", (self.lower(left), self.lower(right)))

    def _conditional(self, node: Node) -> Expression:
        parts = [node.child_by_field_name(name) for name in ("condition", "consequence", "alternative")]
        parts[1] = parts[1] or parts[0]
        return Operation("?:", tuple([self.lower(part) for part in parts if part is not None]))

    def _inner(self, node: Node) -> Expression:
        """Return the meaning of the last part: a cast is its value, ``&x`` and ``*x`` are ``x``."""
        children = [child for child in node.named_children if child.type != "comment"]
        return self.lower(children[-1]) if children else opaque(self._lowered.text(node))

    def _new(self, node: Node) -> Expression:
        type_, values = node.child_by_field_name("type"), node.child_by_field_name("arguments")
        if type_ is None or is_primitive(self._lowered.text(type_)):
            return self._other(node)
        name, templates = name_and_templates(self._lowered.text(type_))
        row, column = node.start_point
        arguments = self.several(values) if values is not None else ()
        return Call(name_of(name), arguments, (), templates, row + 1, column + 1)

    def _compound(self, node: Node) -> Expression:
        type_, values = node.child_by_field_name("type"), node.child_by_field_name("value")
        if type_ is None or values is None:
            return self._other(node)
        return self.construct(self._lowered.text(type_), values, node)

    def _designated(self, node: Node) -> Expression:
        children = node.named_children
        name = text_of(self._lowered.text(children[0])).lstrip(". ")
        return Operation("=", (name_of(name), self.lower(children[-1])))

    def _sequence(self, node: Node) -> Expression:
        return Sequence(self.several(node))

    def _text(self, node: Node) -> Expression:
        return Literal(text_value(text_of(self._lowered.text(node))))

    def _joined(self, node: Node) -> Expression:
        """Return texts that stand side by side as one; with a macro among them they are added."""
        parts: list[Expression] = []
        for part in self.several(node):
            last = parts[-1] if parts else None
            if _is_text(part) and _is_text(last):
                parts[-1] = Literal(f"{last.value}{part.value}")
            else:
                parts.append(part)
        return parts[0] if len(parts) == 1 else Operation("+", tuple(parts))

    def _number(self, node: Node) -> Expression:
        written = self._lowered.text(node)
        value = number_value(text_of(written))
        return Literal(value) if value is not None else opaque(written)

    def _suffixed(self, node: Node) -> Expression:
        children = node.named_children
        suffix = text_of(self._lowered.text(children[-1]))
        value = self.lower(children[0])
        if _is_text(value) and suffix in _TEXT_SUFFIXES:
            return value
        return Call(name_of(suffix), (value,))

    def _truth(self, node: Node) -> Expression:
        return Literal(node.type == "true")

    def _nothing(self, _node: Node) -> Expression:
        return Literal(None)

    def _opaque(self, node: Node) -> Expression:
        return opaque(self._lowered.text(node))

    def _lambda(self, node: Node) -> Expression:
        return self.on_lambda(node)

    def _other(self, node: Node) -> Expression:
        """Return the text of what is not understood, with the calls in it before it."""
        text = self._lowered.text(node)
        if b"(" not in text and b"{" not in text:
            return opaque(text)
        parts = [self.lower(child) for child in node.named_children if child.type not in _NO_EXPRESSIONS]
        calls = [part for part in parts if not isinstance(part, _SIMPLE)]
        return Operation(",", (*calls, opaque(text))) if calls else opaque(text)


def _operator(node: Node) -> str:
    operator = node.child_by_field_name("operator")
    return operator.type if operator is not None else ""


@lru_cache(maxsize=8192)
def _named(written: bytes) -> Expression:
    return name_of(name_and_templates(written)[0])


def _is_text(expression: Expression | None) -> TypeGuard[Literal]:
    return isinstance(expression, Literal) and isinstance(expression.value, str)


def _formatted(values: tuple[Expression, ...]) -> Format | None:
    """Return the parts of ``format("{}/x", a)``; None where the format is no text in place."""
    first = values[0] if values else None
    if not isinstance(first, Literal) or not isinstance(first.value, str):
        return None
    template, arguments = first.value, values[1:]
    parts: list[Expression] = []
    text, end, following = "", 0, 0
    for match in _PLACEHOLDER.finditer(template):
        text += template[end : match.start()]
        end = match.end()
        if match[0] in ("{{", "}}"):
            text += match[0][0]
            continue
        number = int(match[1]) if match[1] else following
        following += 1
        value = arguments[number] if number < len(arguments) else Opaque(match[0])
        # How a value is written out is not followed; the calls in it are kept.
        part = value if not match[2] else Operation(",", (value, Opaque(match[0])))
        parts += [Literal(text), part] if text else [part]
        text = ""
    text += template[end:]
    return Format((*parts, Literal(text)) if text else tuple(parts))


def _only(values: tuple[Expression, ...]) -> Expression | None:
    return values[0] if len(values) == 1 else None


_INSTEAD: dict[str, Callable[[tuple[Expression, ...]], Expression | None]] = {
    **dict.fromkeys(("static_cast", "dynamic_cast", "const_cast", "reinterpret_cast"), _only),
    **dict.fromkeys(("fmt.format", "std.format", "std.vformat"), _formatted),
}
"""Function to what stands for a call of it with such arguments; None where the call stays."""
_NO_EXPRESSIONS = frozenset({"comment", "type_descriptor", "primitive_type", "type_identifier", "type_qualifier"})
_KINDS = {
    "name": "identifier field_identifier type_identifier namespace_identifier qualified_identifier template_function "
    "template_type this type_descriptor primitive_type",
    "text": "string_literal raw_string_literal char_literal",
    "inner": "cast_expression pointer_expression co_await_expression parenthesized_expression",
    "member": "field_expression",
    "item": "subscript_expression",
    "call": "call_expression",
    "binary": "binary_expression",
    "unary": "unary_expression",
    "assignment": "assignment_expression",
    "conditional": "conditional_expression",
    "new": "new_expression",
    "compound": "compound_literal_expression",
    "designated": "initializer_pair",
    "sequence": "initializer_list argument_list",
    "joined": "concatenated_string",
    "number": "number_literal",
    "suffixed": "user_defined_literal",
    "truth": "true false",
    "nothing": "null nullptr",
    "opaque": "parameter_pack_expansion sizeof_expression",
    "lambda": "lambda_expression",
}
_HANDLERS: dict[str, Callable[[Expressions, Node], Expression]] = {
    kind: getattr(Expressions, f"_{method}") for method, kinds in _KINDS.items() for kind in kinds.split()
}
"""Kind of a node to the method that lowers it."""
