"""Parameters of functions and templates of C++, and the data members of classes."""

from __future__ import annotations

import re

from tree_sitter import Node

from roslens.source.extract.ir.program import Expression, Field, Literal, Parameter
from roslens.source.extract.lowering.cpp.cpp_expressions import Expressions
from roslens.source.extract.lowering.cpp.cpp_lowered import Lowered
from roslens.source.extract.lowering.cpp.cpp_types import declared_name, declared_type
from roslens.source.syntax.cpp_names import text_of

_KINDS = ("parameter_declaration", "optional_parameter_declaration", "variadic_parameter_declaration")
_PLAIN_FIELD = re.compile(rb"(?P<type>[^()=,{}/\n]*[\w>*&\s])(?<=[>*&\s])(?P<name>[A-Za-z_]\w*)\s*;")
_LAST_WORD = re.compile(r"([A-Za-z_]\w*)\W*\Z")
_MOST_REMEMBERED = 8192


class Parameters:
    """Lowers parameters and fields; those without a value are known by their text."""

    def __init__(self, lowered: Lowered, expressions: Expressions) -> None:
        """Lower for ``lowered``."""
        self._lowered = lowered
        self._expressions = expressions

    def of(self, declarator: Node) -> tuple[Parameter, ...]:
        """Return the parameters of a function, given its declarator."""
        listed = declarator.child_by_field_name("parameters")
        if listed is None:
            return ()
        parameters = [self._parameter(node) for node in listed.named_children if node.type in _KINDS]
        return () if parameters == [_NONE] else tuple(parameters)

    def _parameter(self, node: Node) -> Parameter:
        text = self._lowered.text(node)
        known = _REMEMBERED.get(text)
        if known is not None:
            return known
        declarator, default = node.child_by_field_name("declarator"), node.child_by_field_name("default_value")
        end = default.start_byte if default is not None else node.end_byte
        middle = declarator.start_byte if declarator is not None else end
        before = self._lowered.source[node.start_byte : middle]
        written = self._lowered.text(declarator) if declarator is not None else b""
        value = self._expressions.lower(default) if default is not None else None
        parameter = Parameter(declared_name(written), declared_type(before, written), value)
        if value is None and len(_REMEMBERED) < _MOST_REMEMBERED:
            _REMEMBERED[text] = parameter
        return parameter

    def template_names(self, listed: Node) -> tuple[str, ...]:
        """Return the names of template parameters."""
        names = []
        for node in listed.named_children:
            if node.type != "comment":
                found = _LAST_WORD.search(text_of(self._lowered.text(node)).partition("=")[0])
                names.append(found[1] if found else "")
        return tuple(names)

    def fields(self, node: Node) -> list[Field]:
        """Return the data members that a declaration in a class declares; none of member functions."""
        text = self._lowered.text(node)
        plain = _PLAIN_FIELD.fullmatch(text)
        if plain and not text.startswith((b"using", b"typedef", b"friend")):
            type_text = declared_type(plain["type"])
            return [Field(text_of(plain["name"]), type_text, None, node.start_point.row + 1)] if type_text else []
        first, type_ = node.child_by_field_name("declarator"), node.child_by_field_name("type")
        if type_ is None or first is None or self._is_one_function(node, first):
            return []
        return [field for field in self._declared(node, type_) if field.name]

    def _declared(self, node: Node, type_: Node) -> list[Field]:
        """Return what each declarator declares, with the value behind it; nothing of a function."""
        found: list[Field] = []
        pending: tuple[bytes, bytes] | None = None
        before, line = b"", node.start_point.row + 1
        for number, child in enumerate(node.children):
            part = node.field_name_for_child(number)
            if part == "declarator":
                before = before or self._lowered.source[node.start_byte : child.start_byte]
                if pending is not None:
                    found.append(_field(*pending, None, line))
                written = self._lowered.text(child)
                pending = None if _is_function(written) else (before, written)
            elif part == "default_value" and pending is not None:
                found.append(_field(*pending, self._value(type_, child, pending[1]), line))
                pending = None
        if pending is not None:
            found.append(_field(*pending, None, line))
        return found

    def _is_one_function(self, node: Node, declarator: Node) -> bool:
        """Return whether a declaration declares a function and nothing behind it."""
        end = declarator.end_byte
        if _END.fullmatch(self._lowered.source, end, node.end_byte) is None:
            return False
        return _is_function(self._lowered.source[declarator.start_byte : end])

    def _value(self, type_: Node, value: Node, declarator: bytes) -> Expression:
        """Return the value of a member; ``{a, b}`` right behind the name constructs its type."""
        before = self._lowered.source[max(0, value.start_byte - 3) : value.start_byte]
        if value.type != "initializer_list" or b"=" in before or b"[" in declarator:
            return self._expressions.lower(value)
        if declarator[:1] in b"*&":
            values = self._expressions.several(value)
            return values[0] if values else Literal(None)
        return self._expressions.construct(self._lowered.text(type_), value, type_)


def given_back(parameters: tuple[Parameter, ...]) -> tuple[str, ...]:
    """Return the names of parameters that a function may set for its caller."""
    return tuple(one.name for one in parameters if one.type[-1:] == "&" and one.name and "const" not in one.type)


def _field(before: bytes, declarator: bytes, value: Expression | None, line: int) -> Field:
    return Field(declared_name(declarator), declared_type(before, declarator), value, line)


def _is_function(declarator: bytes) -> bool:
    return _FUNCTION.match(declarator) is not None


_FUNCTION = re.compile(rb"[\s*&]*(?:operator\b|~?\w+\s*\()")
_END = re.compile(rb"\s*(?:=\s*0\s*)?;")
_NONE = Parameter("", "void")
_REMEMBERED: dict[bytes, Parameter] = {}
