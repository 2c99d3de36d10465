"""Variables that C++ declares: their types and values, constructions that look like functions included."""

from __future__ import annotations

import re
from collections.abc import Callable

from tree_sitter import Node

from roslens.source.extract.ir.program import Assign, Call, Expression, Item, Literal, Member, Name, Sequence, Statement
from roslens.source.extract.lowering.cpp.cpp_expressions import Expressions
from roslens.source.extract.lowering.cpp.cpp_lowered import Lowered, name_of
from roslens.source.extract.lowering.cpp.cpp_types import declared_name, declared_type, name_and_templates
from roslens.source.syntax.cpp_names import function_declarator

_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
_POINTING = ("pointer_declarator", "reference_declarator")
_REFERRING = (b"&", b"*")
_TYPE_NAMES = ("type_identifier", "qualified_identifier", "template_type")
_DIRECT = ("argument_list", "initializer_list")

Statements = list[Statement]
OnDefinition = Callable[[Node, Statements], bool]


class Variables:
    """Lowers declarations of variables."""

    def __init__(self, lowered: Lowered, expressions: Expressions) -> None:
        """Lower for ``lowered``."""
        self._lowered = lowered
        self._expressions = expressions
        self._lower = expressions.lower

    def declare(self, node: Node, out: Statements, on_definition: OnDefinition, prefix: str | None = None) -> None:
        """Add the lowering of a declaration of variables; ``prefix`` is the scope with its dot, None of local ones."""
        type_ = node.child_by_field_name("type")
        declarators = node.children_by_field_name("declarator")
        body = type_.child_by_field_name("body") if type_ is not None else None
        if type_ is not None and body is not None:
            on_definition(type_, out)
        if type_ is None or not declarators:
            return
        before = self._lowered.source[node.start_byte : (body or declarators[0]).start_byte]
        single = node.child_by_field_name("value")
        for declarator in declarators:
            self._declare(node, type_, declarator, before, single, prefix, out)

    def _declare(
        self,
        node: Node,
        type_: Node,
        whole: Node,
        before: bytes,
        value: Node | None,
        prefix: str | None,
        out: Statements,
    ) -> None:
        declarator, kind = whole, whole.type
        if kind == "init_declarator":
            declarator = whole.child_by_field_name("declarator") or whole
            value = whole.child_by_field_name("value")
        written = self._lowered.text(declarator)
        made: Expression | None = None
        if kind == "function_declarator":
            found = self._vexing(type_, whole, node) if prefix is None else None
            if found is None:
                return
            written, made = found
        elif kind in _POINTING and b"(" in written and function_declarator(whole) is not None:
            return
        elif value is not None:
            made = self._initial(node, type_, declarator, written, value)
        target = target_of(written, prefix or "")
        if target is None:
            return
        how = self._held(before, written, value, made) if prefix is None else "="
        out.append(Assign(target, made, declared_type(before, written), how, node.start_point.row + 1))

    def _held(self, before: bytes, written: bytes, value: Node | None, made: Expression | None) -> str:
        """Return how a local variable holds its value.

        Returns:
            ``static`` of what lives on between calls, ``&`` of what is another name of a variable, ``*`` of what points
            to one, ``=`` of what is none of these.
        """
        if before[:6] == b"static":
            return "static"
        if written[:1] not in _REFERRING or b"const" in before or value is None or not _has_a_place(made):
            return "="
        if written[:1] == b"&":
            return "&"
        return "*" if value.type == "call_expression" or self._lowered.text(value)[:1] == b"&" else "="

    def _initial(self, node: Node, type_: Node, declarator: Node, written: bytes, value: Node) -> Expression:
        """Return the value of a declared variable: ``= value``, ``(values)`` or ``{values}``."""
        between = self._lowered.source[declarator.end_byte : value.start_byte]
        if value.type not in _DIRECT or b"=" in between:
            return self._lower(value)
        if written[:1] in b"*&" or b"[" in written:
            values = self._expressions.several(value)
            if not values and b"[" not in written:
                return Literal(None)
            return values[0] if len(values) == 1 and b"[" not in written else Sequence(values)
        return self._expressions.construct(self._lowered.text(type_), value, node)

    def _vexing(self, type_: Node, declarator: Node, node: Node) -> tuple[bytes, Call] | None:
        """Return name and call of ``Type name(a, b);`` inside a function, though it parses as a declaration."""
        declared = declarator.child_by_field_name("declarator")
        arguments = self._vexing_arguments(declarator) if declared is not None else None
        if declared is None or not arguments:
            return None
        name, templates = name_and_templates(self._lowered.text(type_))
        row, column = node.start_point
        return self._lowered.text(declared), Call(name_of(name), arguments, (), templates, row + 1, column + 1)

    def _vexing_arguments(self, declarator: Node) -> tuple[Expression, ...] | None:
        """Return the arguments that parse as parameters; None where they cannot be arguments."""
        parameters = declarator.child_by_field_name("parameters")
        if parameters is None or self._lowered.too_deep(declarator):
            return None
        arguments: list[Expression] = []
        for one in parameters.named_children:
            if one.type == "comment":
                continue
            argument = self._vexing_argument(one)
            if argument is None:
                return None
            arguments.append(argument)
        return tuple(arguments)

    def _vexing_argument(self, one: Node) -> Expression | None:
        """Return the argument ``a``, ``a(b)`` or ``a[1]`` that parses as a type with an abstract declarator."""
        children = one.named_children
        if one.type != "parameter_declaration" or children[0].type not in _TYPE_NAMES or len(children) > 2:
            return None
        of = self._lower(children[0])
        if len(children) == 1:
            return of
        if children[1].type == "abstract_function_declarator":
            self._lowered.depth += 1
            inner = self._vexing_arguments(children[1])
            self._lowered.depth -= 1
            name, templates = name_and_templates(self._lowered.text(children[0]))
            row, column = one.start_point
            return Call(name_of(name), inner, (), templates, row + 1, column + 1) if inner is not None else None
        size = children[1].child_by_field_name("size")
        return Item(of, self._lower(size)) if size is not None else None


def target_of(declarator: bytes, prefix: str = "") -> Expression | None:
    """Return what a declarator declares: a name, or the names in ``[a, b]``; None of none."""
    name = declared_name(declarator)
    if name:
        return Name(prefix + name)
    names = _IDENTIFIER.findall(declarator.decode("utf-8", "replace")) if b"[" in declarator else ()
    return Sequence(tuple(map(Name, names))) if names else None


def _has_a_place(value: Expression | None) -> bool:
    """Whether a value stands somewhere: in a variable, a member, or where a call without arguments says."""
    return isinstance(value, Name | Member) or (
        isinstance(value, Call) and not value.arguments and not value.templates and value.function != Name("new")
    )
