"""Namespaces, classes, functions, constants and names of a C++ file."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from tree_sitter import Node

from roslens.source.extract.ir.program import (
    NO_EXCEPTION,
    Assign,
    Branch,
    Class,
    Expression,
    Field,
    Function,
    Lambda,
    Statement,
)
from roslens.source.extract.ir.ros_switch import holds
from roslens.source.extract.lowering.cpp.cpp_captures import held_copies
from roslens.source.extract.lowering.cpp.cpp_definition_parts import HANDING, base_arguments, is_guard, tried_body
from roslens.source.extract.lowering.cpp.cpp_expressions import Expressions
from roslens.source.extract.lowering.cpp.cpp_initialisers import lower_initialisers
from roslens.source.extract.lowering.cpp.cpp_lowered import Lowered, name_of, opaque
from roslens.source.extract.lowering.cpp.cpp_macros import is_registration, macro_value
from roslens.source.extract.lowering.cpp.cpp_parameters import Parameters, given_back
from roslens.source.extract.lowering.cpp.cpp_statements import StatementLowering
from roslens.source.extract.lowering.cpp.cpp_types import declared_name, declared_type, dotted, specialised_for
from roslens.source.extract.lowering.cpp.cpp_variables import Statements
from roslens.source.syntax.cpp_names import (
    base_names,
    function_declarator,
    scope_within,
    split_name,
    squeezed,
    text_of,
    without_arguments,
)

_MACRO = re.compile(r"[A-Z][A-Z0-9_]+")
_USING = re.compile(rb"using\s+(namespace\s+)?(?:typename\s+)?(?:::\s*)?([\w:\s]+?)\s*;")
_DEFAULT = re.compile(rb"[^=!<>]=\s*[^=\s][^;]*\)")
_LONGEST_NAME = 4000
_Around = tuple[str, tuple[str, ...], list[Field], tuple[str, ...], str, str]


class Definitions:
    """Lowers what stands outside functions, and definitions inside them."""

    def __init__(self, lowered: Lowered) -> None:
        """Lower into ``lowered``."""
        self._lowered = lowered
        self._expressions = Expressions(lowered)
        self._statements = StatementLowering(lowered, self._expressions)
        self._parameters = Parameters(lowered, self._expressions)
        self._expressions.on_lambda = self._lambda
        self._statements.on_definition = self._definition
        self._where = "file"
        self._fields: list[Field] = []
        self._templates: tuple[str, ...] = ()
        self._own_templates: tuple[str, ...] = ()
        self._bases: dict[str, tuple[str, ...]] = {}
        self._hidden = 0

    def add(self, nodes: Iterable[Node], out: Statements) -> None:
        """Add what ``nodes`` define to the program, and what they do where no function is to ``out``."""
        if self._where == "function":
            self._statements.add(nodes, out)
            return
        for node in nodes:
            kind = node.type
            handler = _HANDLERS.get(kind) or _OUTSIDE.get(kind)
            if handler is not None:
                handler(self, node, out)
            elif kind == "expression_statement" and is_registration(self._lowered.text(node)):
                continue
            else:
                self._statements.add((node,), out)

    def end(self) -> None:
        """Let go of who lowers the rest: holding each other, they and the tree would wait as garbage."""
        del self._expressions.on_lambda, self._statements.on_definition

    def _definition(self, node: Node, out: Statements) -> bool:
        handler = _HANDLERS.get(node.type)
        if handler is not None:
            handler(self, node, out)
        return handler is not None

    def _enter(self, where: str, templates: tuple[str, ...], scope: str, class_name: str) -> _Around:
        """Enter a namespace, class or function; return what :meth:`_leave` needs."""
        lowered = self._lowered
        around = self._where, self._templates, self._fields, self._own_templates, lowered.scope, lowered.class_name
        self._where, self._templates, self._own_templates = where, templates, ()
        lowered.scope, lowered.class_name = scope, class_name
        lowered.depth += 1
        return around

    def _leave(self, around: _Around) -> None:
        lowered = self._lowered
        lowered.depth -= 1
        self._where, self._templates, self._fields, self._own_templates, lowered.scope, lowered.class_name = around

    def _nested(self, node: Node, out: Statements) -> None:
        """Add what stands in ``extern "C"``, or in what does not parse."""
        if not self._lowered.too_deep(node):
            self._lowered.depth += 1
            body = node.child_by_field_name("body")
            self.add((body or node).named_children if body is None or body.type == "declaration_list" else (body,), out)
            self._lowered.depth -= 1

    def _namespace(self, node: Node, out: Statements) -> None:
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if body is None or self._lowered.too_deep(node):
            return
        scope = self._lowered.scope
        if name is not None:
            scope = self._lowered.qualified(dotted(text_of(self._lowered.text(name))))
        around = self._enter("file", self._templates, scope, self._lowered.class_name)
        self._hidden += name is None
        self.add(body.named_children, out)
        self._hidden -= name is None
        self._leave(around)

    def _template(self, node: Node, out: Statements) -> None:
        listed = node.child_by_field_name("parameters")
        before = self._own_templates
        self._own_templates = (*before, *self._parameters.template_names(listed)) if listed is not None else before
        inner = node.named_children[-1:]
        if not self._lowered.too_deep(node):
            self._lowered.depth += 1
            self.add(inner, out)
            self._lowered.depth -= 1
        self._own_templates = before

    def _class(self, node: Node, out: Statements) -> None:
        name = node.child_by_field_name("name")
        self.define_class(node, text_of(self._lowered.text(name)) if name is not None else "", out)

    def define_class(self, node: Node, written: str, out: Statements) -> None:
        """Add a class with a body; one that is only declared is none."""
        body = node.child_by_field_name("body")
        if body is None or self._lowered.too_deep(node):
            return
        lowered = self._lowered
        name = dotted(without_arguments(written))
        if not name:
            # The members of a union without name are those of the class around.
            if self._where == "class":
                self._nested(body, out)
            return
        qualified = lowered.qualified(name)
        bases = tuple(map(dotted, base_names(node, lowered.source)))
        simple = name.rpartition(".")[2]
        self._bases[qualified] = (simple, *(base.rpartition(".")[2] for base in bases))
        place, own = len(lowered.classes), self._own_templates
        lowered.classes.append(None)
        around = self._enter("class", (*self._templates, *own), qualified, qualified)
        fields: list[Field] = []
        self._fields = fields
        self.add(body.named_children, out)
        self._leave(around)
        line, arguments = node.start_point.row + 1, base_arguments(node, lowered.source)
        lowered.classes[place] = Class(simple, qualified, line, bases, tuple(fields), own, arguments)

    def _field(self, node: Node, out: Statements) -> None:
        type_ = node.child_by_field_name("type")
        if type_ is not None and type_.type.endswith("_specifier"):
            self._definition(type_, out)
        found = self._parameters.fields(node)
        self._fields += found
        if not found:
            self._declared(node)

    def _declared(self, node: Node) -> None:
        """Note a function that is declared with defaults of its parameters."""
        text = self._lowered.text(node)
        if b"=" not in text or not _DEFAULT.search(text):
            return
        outer = node.child_by_field_name("declarator")
        declarator = function_declarator(outer) if outer is not None else None
        if declarator is None:
            return
        parameters = self._parameters.of(declarator)
        if any(parameter.default is not None for parameter in parameters):
            name, qualified, class_name = self._named(declarator, declarator.start_byte)
            line = declarator.start_point.row + 1
            templates = (*self._templates, *self._own_templates)
            function = Function(name, qualified, line, class_name, parameters, templates=templates)
            self._lowered.declarations.append(function)

    def _variable(self, node: Node, out: Statements) -> None:
        """Add a global or constant, or a function that is declared; a constructor in a class is a declaration too."""
        text = self._lowered.text(node)
        self._declared(node)
        if self._where == "file" and not text.startswith(b"extern"):
            scope = self._lowered.scope
            self._statements.declare(node, out, f"{scope}." if scope else "")

    def _named(self, declarator: Node, start: int) -> tuple[str, str, str]:
        """Return the name, the qualified name and the class of a function."""
        listed = declarator.child_by_field_name("parameters")
        end = listed.start_byte if listed is not None else declarator.end_byte
        scope, name = split_name(text_of(self._lowered.source[start : min(end, start + _LONGEST_NAME)]))
        around = self._lowered.scope
        class_name = self._lowered.class_name if self._where == "class" else ""
        if scope:
            around = self._lowered.qualified(dotted(scope_within(around.replace(".", "::"), scope)) or "").rstrip(".")
            class_name = around
        return name, f"{around}.{name}" if around else name, class_name

    def _function(self, node: Node, _out: Statements) -> None:
        outer = node.child_by_field_name("declarator")
        declarator = function_declarator(outer) if outer is not None else None
        body = node.child_by_field_name("body")
        tried = tried_body(node) if body is None else None
        if outer is None or declarator is None or (body is None and tried is None):
            self._declared(node)
            return
        start = outer.start_byte if declarator.type == "abstract_function_declarator" else declarator.start_byte
        name, qualified, class_name = self._named(declarator, start)
        parameters = self._parameters.of(declarator)
        if parameters and not class_name and _MACRO.fullmatch(name) and node.child_by_field_name("type") is None:
            name = f"{name}({','.join(one.type for one in parameters)})"
            qualified, parameters = self._lowered.qualified(name), ()
        index = self._lowered.begin_function()
        templates = (*self._templates, *self._own_templates)
        around = self._enter("function", templates, qualified, class_name)
        between = self._lowered.source[declarator.end_byte : body.start_byte] if body is not None else b":"
        first = self._initialisers(tried or node, class_name) if b":" in between else ()
        statements = self._body(body, tried)
        self._leave(around)
        line = declarator.start_point.row + 1
        sets = self._statements.sets
        if self._statements.in_part:
            sets += given_back(parameters)
        hands = outer.type in HANDING and b"const" not in self._lowered.source[node.start_byte : outer.start_byte]
        local = not class_name and (self._hidden > 0 or self._is_static(node))
        function = Function(
            name, qualified, line, class_name, parameters, first, statements, templates,
            sets=sets, hands=hands, local=local, specialised=specialised_for(declarator, self._lowered.source),
        )  # fmt: skip
        self._lowered.end_function(index, function)

    def _is_static(self, node: Node) -> bool:
        kinds = (child for child in node.named_children if child.type == "storage_class_specifier")
        return any(self._lowered.text(one) == b"static" for one in kinds)

    def _initialisers(self, node: Node, class_name: str) -> tuple[Statement, ...]:
        listed = next((one for one in node.named_children if one.type == "field_initializer_list"), None)
        known = self._bases.get(class_name, (class_name.rpartition(".")[2],))
        return lower_initialisers(listed, self._lowered, self._expressions, known) if listed is not None else ()

    def _body(self, body: Node | None, tried: Node | None) -> tuple[Statement, ...]:
        if body is not None or tried is None:
            test = self._lowered.scope.endswith(")") and "TEST" in self._lowered.scope
            return self._statements.body(body, test) if body is not None else ()
        inner = tried.child_by_field_name("body")
        then = self._statements.body(inner) if inner is not None else ()
        handlers = self._statements.handlers(tried)
        return (Branch(NO_EXCEPTION, then, handlers, tried.start_point.row + 1),)

    def _lambda(self, node: Node) -> Expression:
        lowered = self._lowered
        body = node.child_by_field_name("body")
        if body is None:
            return opaque(lowered.text(node))
        index = lowered.begin_function()
        qualified = lowered.qualified("lambda")
        around = self._enter("function", self._templates, qualified, lowered.class_name)
        declarator = node.child_by_field_name("declarator")
        parameters = self._parameters.of(declarator) if declarator is not None else ()
        captures = node.child_by_field_name("captures")
        captured = self._captured(captures)
        statements = (*captured, *self._statements.body(body))
        self._leave(around)
        line = node.start_point.row + 1
        function = Function("lambda", qualified, line, lowered.class_name, parameters, (), statements)
        lowered.end_function(index, function)
        return Lambda(index, held_copies(captures, lowered.source, body))

    def _captured(self, captures: Node | None) -> Statements:
        """Return what a lambda captures under another name: ``[topic = name + "/out"]``."""
        found: Statements = []
        for node in captures.named_children if captures is not None else ():
            left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
            if left is not None and right is not None:
                name = name_of(declared_name(self._lowered.text(left)))
                found.append(Assign(name, self._expressions.lower(right), "", "=", node.start_point.row + 1))
        return found

    def _typedef(self, node: Node, out: Statements) -> None:
        type_, declarator = node.child_by_field_name("type"), node.child_by_field_name("declarator")
        if type_ is None or declarator is None:
            return
        written = self._lowered.text(declarator)
        name = declared_name(written)
        if type_.child_by_field_name("body") is not None:
            if type_.child_by_field_name("name") is None and type_.type != "enum_specifier":
                self.define_class(type_, name, out)
                return
            self._definition(type_, out)
        elif name and b"(" not in written:
            self._lowered.imports[self._lowered.qualified(name)] = declared_type(self._lowered.text(type_), written)

    def _alias(self, node: Node, _out: Statements) -> None:
        name, type_ = node.child_by_field_name("name"), node.child_by_field_name("type")
        if name is not None and type_ is not None:
            qualified = self._lowered.qualified(text_of(self._lowered.text(name)))
            self._lowered.imports[qualified] = declared_type(self._lowered.text(type_))

    def _using(self, node: Node, _out: Statements) -> None:
        match = _USING.match(self._lowered.text(node))
        if match is None:
            return
        meaning = "".join(text_of(match[2]).split())
        if match[1]:
            self._lowered.using.append(dotted(meaning))
        elif self._where != "class":
            self._lowered.imports[self._lowered.qualified(meaning.rpartition("::")[2])] = meaning

    def _namespace_alias(self, node: Node, _out: Statements) -> None:
        name, _, meaning = text_of(self._lowered.text(node)).partition("=")
        name = name.removeprefix("namespace").strip()
        self._lowered.imports[self._lowered.qualified(name)] = squeezed(meaning.rstrip("; ")).removeprefix("::")

    def _include(self, node: Node, _out: Statements) -> None:
        path = node.child_by_field_name("path")
        if path is not None:
            self._lowered.includes.append((text_of(self._lowered.text(path)), node.start_point.row + 1))

    def _define(self, node: Node, _out: Statements) -> None:
        name, value = node.child_by_field_name("name"), node.child_by_field_name("value")
        meaning = macro_value(self._lowered.text(value)) if value is not None else None
        if name is not None and meaning is not None:
            self._lowered.define_macro(text_of(self._lowered.text(name)), meaning)

    def _directive(self, node: Node, out: Statements) -> None:
        """Add what an ``#if`` holds: definitions of every arm, statements as a branch.

        Of arms that are for versions of ROS only that of the version counts.
        """
        if self._lowered.too_deep(node):
            return
        self._lowered.depth += 1
        condition = node.child_by_field_name("condition") or node.child_by_field_name("name")
        alternative = node.child_by_field_name("alternative")
        left_out = {one.start_byte for one in (condition, alternative) if one is not None}
        inner = [child for child in node.named_children if child.start_byte not in left_out]
        written = self._lowered.text(node).partition(b"\n")[0]
        held = holds(written, self._lowered.version) if self._lowered.version else None
        if held is True or is_guard(condition, inner, self._lowered.source):
            self.add(inner, out)
        elif held is False:
            self.add(() if alternative is None else (alternative,), out)
        else:
            then: Statements = []
            otherwise: Statements = []
            self.add(inner, then)
            if alternative is not None:
                self.add((alternative,), otherwise)
            if then or otherwise:
                out.append(Branch(opaque(written), tuple(then), tuple(otherwise), node.start_point.row + 1))
        self._lowered.depth -= 1

    def _friend(self, node: Node, out: Statements) -> None:
        self.add([child for child in node.named_children if child.type == "function_definition"], out)

    def _silent(self, node: Node, out: Statements) -> None:
        """Skip nodes that do not affect the graph."""


def _table(kinds: dict[str, str]) -> dict[str, Callable[[Definitions, Node, Statements], None]]:
    return {kind: getattr(Definitions, f"_{method}") for method, listed in kinds.items() for kind in listed.split()}


_HANDLERS = _table(
    {
        "namespace": "namespace_definition",
        "template": "template_declaration",
        "class": "class_specifier struct_specifier union_specifier",
        "function": "function_definition inline_method_definition",
        "typedef": "type_definition",
        "alias": "alias_declaration",
        "using": "using_declaration",
        "namespace_alias": "namespace_alias_definition",
        "include": "preproc_include",
        "define": "preproc_def",
        "directive": "preproc_if preproc_ifdef preproc_elif preproc_elifdef",
        "nested": "linkage_specification preproc_else declaration_list",
        "friend": "friend_declaration",
        "silent": "enum_specifier template_instantiation access_specifier preproc_call preproc_function_def comment "
        "concept_definition preproc_directive preproc_arg",
    }
)
_OUTSIDE = _table({"nested": "ERROR", "variable": "declaration", "field": "field_declaration"})
