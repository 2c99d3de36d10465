"""Expressions of Python, lowered from the tree of the one parse.

What no ``Expression`` (``ir/program.py``) says becomes statements that stand before the one it is in:

- a comprehension is a loop that fills ``#1`` (a list, set and generator by ``+= [item]``, a dictionary by item), and
  its variables are renamed, ``t`` to ``t#1``, since they are not those of the function around it;
- ``name := value`` is an assignment, and its value the name;
- calls inside something opaque (``a | f(b)``) and what is yielded are evaluated.

So they are before the statement even where a condition decides whether they are evaluated at all.
"""

from __future__ import annotations

import re
from bisect import bisect_right

from tree_sitter import Node

from roslens.source.extract.ir.program import (
    Call,
    Expression,
    Format,
    Item,
    Literal,
    Mapping,
    Member,
    Name,
    Opaque,
    Operation,
    Parameter,
    Sequence,
)
from roslens.source.extract.lowering.python.python_program_literals import (
    LONGEST_TEXT,
    braces,
    converted,
    joined,
    number,
    percent,
    unescape,
)
from roslens.source.extract.lowering.python.python_program_made import Made
from roslens.source.extract.lowering.python.python_program_reading import DEEPEST
from roslens.source.syntax.python_names import text_of
from roslens.source.syntax.python_tree import LANGUAGE

MOST_ITEMS = 500
"""Items of a list or dictionary that are kept; a longer one is a table of numbers."""
_LONGEST_KNOWN = 200

_CHAIN = re.compile(rb"[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*")
_PLAIN_TEXT = re.compile(rb"""[uUbB]?(?:'([^'"\\\n]*)'|"([^'"\\\n]*)")""")
_TEXT = re.compile(r"([A-Za-z]*)('''|\"\"\"|'|\")(.*)", re.DOTALL)
_WORD = re.compile(r"[^\W\d]\w*")
_KEPT_OPERATORS = frozenset(("+", "-", "*", "/", "%", "<<"))
_COMPARISONS = {"is": "==", "is not": "!=", "<>": "!=", "==": "==", "!=": "!=", "<": "<", ">": ">", "<=": "<=",
                ">=": ">=", "in": "in"}  # fmt: skip
_HANDLERS = {
    "identifier": "attribute",
    "dotted_name": "attribute",
    "keyword_identifier": "attribute",
    "attribute": "attribute",
    "string": "string",
    "concatenated_string": "concatenated",
    "integer": "number",
    "float": "number",
    "true": "constant",
    "false": "constant",
    "none": "constant",
    "call": "call",
    "subscript": "subscript",
    "binary_operator": "binary",
    "boolean_operator": "boolean",
    "not_operator": "negation",
    "unary_operator": "unary",
    "comparison_operator": "comparison",
    "conditional_expression": "conditional",
    "parenthesized_expression": "first",
    "await": "first",
    "type": "first",
    "case_pattern": "first",
    "list": "sequence",
    "tuple": "sequence",
    "set": "sequence",
    "expression_list": "sequence",
    "pattern_list": "sequence",
    "tuple_pattern": "sequence",
    "list_pattern": "sequence",
    "dictionary": "dictionary",
    "list_comprehension": "comprehension",
    "set_comprehension": "comprehension",
    "generator_expression": "comprehension",
    "dictionary_comprehension": "comprehension",
    "lambda": "function_without_name",
    "named_expression": "named",
    "as_pattern": "as_pattern",
    "yield": "yielded",
    "ellipsis": "text_only",
    "slice": "opaque",
}


def _kind(name: str, *, named: bool = True) -> int:
    return LANGUAGE.id_for_node_kind(name, named) or 0


_KINDS = {_kind(name): method for name, method in _HANDLERS.items()}
_ARGUMENTS, _KEYWORD = _kind("argument_list"), _kind("keyword_argument")
_COMMENT, _PAIR = _kind("comment"), _kind("pair")
_SPLAT, _DOUBLE_SPLAT = _kind("list_splat"), _kind("dictionary_splat")
_SPREAD = frozenset({"identifier", "attribute", "list", "tuple"})
_SIGNS = frozenset(_kind(sign, named=False) for sign in "(),[]{}:;") | {_COMMENT}
_CONSTANTS = {_kind("true"): Literal(True), _kind("false"): Literal(False), _kind("none"): Literal(None)}
_FOR, _IF = _kind("for_in_clause"), _kind("if_clause")
_INTERPOLATION, _CONTENT = _kind("interpolation"), _kind("string_content")
_TUPLE, _PARENTHESES = _kind("tuple"), _kind("parenthesized_expression")


class Expressions(Made):
    """Lowers the expressions of one file.

    Attributes:
        operators: those of two values that are kept; what others come to is opaque.
    """

    operators = _KEPT_OPERATORS

    def __init__(self, source: bytes) -> None:
        """Begin with the source that was parsed."""
        super().__init__(source)
        self._lower = {kind: getattr(self, f"_{method}") for kind, method in _KINDS.items()}

    def expression(self, node: Node) -> Expression:
        """Return the lowering of ``node``; what is not understood is :class:`Opaque`."""
        if self._depth >= DEEPEST:
            return self._too_deep(node)
        self._depth += 1
        result: Expression = self._lower.get(node.kind_id, self._opaque)(node)
        self._depth -= 1
        return result

    def parameters(self, node: Node | None) -> tuple[Parameter, ...]:
        """Return parameters as written, with their stars; ``/`` and ``*`` alone are none."""
        if node is None:
            return ()
        return tuple(found for child in self.parts(node) if (found := self._parameter(child)) is not None)

    def _parameter(self, node: Node) -> Parameter | None:
        kind = node.type
        if kind in {"keyword_separator", "positional_separator", "ERROR"}:
            return None
        if kind in {"default_parameter", "typed_default_parameter"}:
            name, value = node.child_by_field_name("name"), node.child_by_field_name("value")
            default = self.expression(value) if value is not None else None
            return Parameter(self.squeezed(name), self.squeezed(node.child_by_field_name("type")), default)
        if kind == "typed_parameter":
            return Parameter(self.squeezed(node.child(0)), self.squeezed(node.child_by_field_name("type")))
        return Parameter(self.squeezed(node))

    # Names and literals

    def _attribute(self, node: Node) -> Expression:
        start, end = node.start_byte, node.end_byte
        if end - start <= _LONGEST_KNOWN:
            written = self.source[start:end]
            known = self._known.get(written)
            if known is not None:
                return known
            if _CHAIN.fullmatch(written):
                first, *members = written.decode().split(".")
                result: Expression = Name(self._names.get(first, first))
                for member in members:
                    result = Member(result, member)
                self._known[written] = result
                return result
        children = node.children
        if len(children) > 1:
            of = children[0].children[-1] if children[0].kind_id == _SPLAT else children[0]
            return Member(self.expression(of), self.text(children[-1]))
        name = self.text(node)
        return Name(self._names.get(name, name)) if name else Opaque("")

    def _number(self, node: Node) -> Expression:
        value = number(self.text(node))
        return self._text_only(node) if value is None else Literal(value)

    def _constant(self, node: Node) -> Expression:
        return _CONSTANTS[node.kind_id]

    def _string(self, node: Node) -> Expression:
        start, end = node.start_byte, node.end_byte
        written = self.source[start : min(end, start + _LONGEST_KNOWN + 1)]
        known = self._known.get(written)
        if known is None:
            plain = _PLAIN_TEXT.fullmatch(written) if end - start <= _LONGEST_KNOWN else None
            if plain is None:
                return self._written_otherwise(node)
            known = self._known[written] = Literal(text_of(plain[1] or plain[2] or b""))
        return known

    def _written_otherwise(self, node: Node) -> Expression:
        """Return a text with escapes, a prefix or values in it."""
        if node.end_byte - node.start_byte > LONGEST_TEXT:
            return self._opaque(node)
        match = _TEXT.fullmatch(self.text(node))
        if match is None:
            return self._text_only(node)
        prefix, content = match[1].lower(), match[3].removesuffix(match[2])
        raw = "r" in prefix
        if not ("f" in prefix or "t" in prefix):
            return Literal(content if raw else unescape(content))
        parts: list[Expression] = []
        for child in node.children:
            if child.kind_id == _CONTENT:
                literal = self.text(child).replace("{{", "{").replace("}}", "}")
                parts.append(Literal(literal if raw else unescape(literal)))
            elif child.kind_id == _INTERPOLATION:
                parts.append(self._interpolation(child))
        return joined(parts)

    def _interpolation(self, node: Node) -> Expression:
        inner, layout = node.child_by_field_name("expression"), node.child_by_field_name("format_specifier")
        conversion = node.child_by_field_name("type_conversion")
        spec = self.text(layout).removeprefix(":") if layout is not None else ""
        if inner is None or "{" in spec or any(child.type == "=" for child in node.children):
            return self._opaque(node)
        value = self.expression(inner)
        return converted(value, self.text(conversion).removeprefix("!") if conversion is not None else "", spec)

    def _concatenated(self, node: Node) -> Expression:
        parts: list[Expression] = []
        for child in self.parts(node):
            part = self.expression(child)
            parts += part.parts if isinstance(part, Format) else (part,)
        return joined(parts)

    # Calls and operators

    def _call(self, node: Node) -> Expression:
        children = node.children
        # ``*f()`` may be a call of ``*f`` to the parser.
        called = children[0]
        function = self.expression(called.children[-1] if called.kind_id == _SPLAT else called)
        arguments: list[Expression] = []
        keywords: list[tuple[str, Expression]] = []
        given = children[-1]
        if given.kind_id == _ARGUMENTS:
            self._arguments(given, arguments, keywords)
        elif len(children) > 1:
            arguments.append(self.expression(given))
        if isinstance(function, Member) and function.name == "format" and isinstance(function.of, Literal):
            text = self._formatted(function.of, arguments, dict(keywords))
            if text is not None:
                return text
        self._calls += 1
        start = node.start_byte + self._starred(node)
        line = bisect_right(self._starts, start)
        column = start - self._starts[line - 1] + 1
        return Call(function, tuple(arguments), tuple(keywords), (), line, column)

    def _arguments(self, given: Node, arguments: list[Expression], keywords: list[tuple[str, Expression]]) -> None:
        """Add the arguments between the parentheses of a call."""
        for child in given.children:
            kind = child.kind_id
            if kind in _SIGNS:
                continue
            if kind == _KEYWORD:
                parts = child.children
                keywords.append((self.text(parts[0]), self.expression(parts[-1])))
            elif kind == _DOUBLE_SPLAT:
                keywords.append(("**", self.expression(child.children[-1])))
            else:
                value = self._item(child)
                arguments.append(value)
                if kind == _SPLAT and type(value) is Opaque and value.text[:1] == "*":
                    spread = child.children[-1]
                    keywords.append(("*", self.expression(spread) if spread.type in _SPREAD else value))

    def _formatted(
        self, template: Literal, arguments: list[Expression], keywords: dict[str, Expression]
    ) -> Expression | None:
        if not isinstance(template.value, str) or "**" in keywords or any(isinstance(one, Opaque) for one in arguments):
            return None
        return braces(template.value, arguments, keywords)

    def _subscript(self, node: Node) -> Expression:
        of, *keys = (self.expression(part) for part in self.parts(node))
        if not keys:
            return self._text_only(node)
        return Item(of, keys[0] if len(keys) == 1 else Sequence(tuple(keys)))

    def _binary(self, node: Node) -> Expression:
        children = node.children
        operator = self.text(children[1]) if len(children) == 3 else ""
        if operator not in self.operators:
            return self._opaque(node)
        left, right = self.expression(children[0]), self.expression(children[2])
        if operator == "%" and isinstance(left, Literal) and isinstance(left.value, str):
            items = right.items if isinstance(right, Sequence) and self._is_tuple(children[2]) else None
            text = percent(left.value, right, items)
            if text is not None:
                return text
        return Operation(operator, (left, right))

    def _is_tuple(self, node: Node) -> bool:
        while node.kind_id == _PARENTHESES and (parts := self.parts(node)):
            node = parts[0]
        return node.kind_id == _TUPLE

    def _boolean(self, node: Node) -> Expression:
        children = node.children
        operator = children[1].type if len(children) == 3 else ""
        if operator not in {"and", "or"}:
            return self._opaque(node)
        return Operation(operator, (self.expression(children[0]), self.expression(children[2])))

    def _negation(self, node: Node) -> Expression:
        return Operation("not", (self.expression(node.children[-1]),))

    def _unary(self, node: Node) -> Expression:
        children = node.children
        operator = children[0].type
        if operator == "~":
            return self._opaque(node)
        value = self.expression(children[-1])
        if operator == "+":
            return value
        if isinstance(value, Literal) and isinstance(value.value, int | float) and not isinstance(value.value, bool):
            return Literal(-value.value)
        return Operation("-", (value,))

    def _comparison(self, node: Node) -> Expression:
        found: list[Expression] = []
        left: Expression | None = None
        operator = ""
        for child in node.children:
            if child.kind_id == _COMMENT:
                continue
            if not child.is_named:
                operator = f"{operator} {child.type}".strip()
                continue
            right = self.expression(child)
            if left is not None:
                found.append(self._compared(left, operator, right))
            left, operator = right, ""
        if not found:
            return self._text_only(node)
        return found[0] if len(found) == 1 else Operation("and", tuple(found))

    def _compared(self, left: Expression, operator: str, right: Expression) -> Expression:
        if operator == "not in":
            return Operation("not", (Operation("in", (left, right)),))
        return Operation(_COMPARISONS.get(operator, operator), (left, right))

    def _conditional(self, node: Node) -> Expression:
        parts = self.parts(node)
        if len(parts) != 3:
            return self._opaque(node)
        then, condition, otherwise = map(self.expression, parts)
        return Operation("?:", (condition, then, otherwise))

    def _yielded(self, node: Node) -> Expression:
        return self._opaque(node)

    # Displays

    def _sequence(self, node: Node) -> Expression:
        items = [child for child in node.children if child.kind_id not in _SIGNS]
        if len(items) > MOST_ITEMS:
            self.note(node, f"more than {MOST_ITEMS} items")
            return self._text_only(node)
        return Sequence(tuple(map(self._item, items)))

    def _item(self, node: Node) -> Expression:
        """Return an item or argument; ``*a.b()``, to the parser a member of ``*a``, is opaque like all of them."""
        if self._starred(node):
            return self._opaque(node) if node.kind_id == _SPLAT else self._splat(node)
        return self.expression(node)

    def _starred(self, node: Node) -> bool:
        return self.source[node.start_byte : node.start_byte + 1] == b"*"

    def _splat(self, node: Node) -> Opaque:
        self.evaluate(node)
        return self._text_only(node)

    def _dictionary(self, node: Node) -> Expression:
        items = self.parts(node)
        if len(items) > MOST_ITEMS:
            self.note(node, f"more than {MOST_ITEMS} items")
            return self._text_only(node)
        pairs: list[tuple[Expression, Expression]] = []
        for item in items:
            children = item.children
            if item.kind_id == _PAIR:
                pairs.append((self.expression(children[0]), self.expression(children[-1])))
            elif item.kind_id == _DOUBLE_SPLAT:
                pairs.append((Opaque("**"), self.expression(children[-1])))
        return Mapping(tuple(pairs))
