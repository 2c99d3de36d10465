"""Statements of Python, lowered from the tree of the one parse.

- ``global x`` is a declaration of ``x`` without value whose type is ``global``; ``nonlocal`` likewise.
- A function inside a function is an assignment of a :class:`~roslens.source.extract.ir.program.Lambda` to its name,
  where its definition stands; a function of the module or of a class is found by its qualified name.
- The object that a method is called on is ``self`` whatever it is named, the class of a ``classmethod`` is ``cls``;
  neither is a parameter.
- In the body of a class, attributes become fields; other statements stand where the class stands.
- Several handlers of a ``try`` are branches on ``Opaque("except KeyError")``; what ``else`` and ``finally`` hold
  follows what it is run after. ``raise`` is the evaluation of what it calls; ``else`` of a loop stands behind it, on
  ``Opaque("no break")`` where there is any.
- A branch without statements whose condition calls nothing is left out.
- What ``match`` looks at is assigned to ``#1`` before, where it is a call.
- ``a = b = f()`` is ``a = f()`` and ``b = a``; ``a, b = c, d`` is two assignments where no value reads a target.
"""

from __future__ import annotations

import re

from tree_sitter import Node

from roslens.source.extract.ir.program import (
    Assign,
    Call,
    Class,
    Evaluate,
    Expression,
    Field,
    Function,
    Item,
    Lambda,
    Leave,
    Member,
    Name,
    Operation,
    Parameter,
    Return,
    Sequence,
)
from roslens.source.extract.lowering.python.python_program_control import Control
from roslens.source.extract.lowering.python.python_program_reading import DEEPEST
from roslens.source.syntax.python_names import base_names, definition_name
from roslens.source.syntax.python_tree import LANGUAGE

_WORD = re.compile(rb"[A-Za-z_]\w*")
_KEPT_OPERATORS = frozenset(("-", "*", "/", "%", "|"))
_CLASS_METHODS = frozenset({"__new__", "__init_subclass__", "__class_getitem__"})
_HANDLERS = {
    "expression_statement": "alone",
    "assignment": "assignment",
    "augmented_assignment": "augmented",
    "function_definition": "function",
    "class_definition": "class",
    "decorated_definition": "decorated",
    "if_statement": "if",
    "for_statement": "for",
    "while_statement": "while",
    "try_statement": "try",
    "with_statement": "with",
    "match_statement": "match",
    "return_statement": "return",
    "raise_statement": "parts_alone",
    "assert_statement": "parts_alone",
    "print_statement": "parts_alone",
    "exec_statement": "parts_alone",
    "delete_statement": "delete",
    "chevron": "parts_alone",
    "keyword_argument": "parts_alone",
    "global_statement": "global",
    "nonlocal_statement": "global",
    "import_statement": "import",
    "import_from_statement": "import_from",
    "future_import_statement": "future",
    "block": "inside",
    "ERROR": "inside",
    **dict.fromkeys(("break_statement", "continue_statement"), "leave"),
    **dict.fromkeys(("pass_statement", "comment"), "nothing"),
    **dict.fromkeys(("type_alias_statement", "string", "identifier", "integer", "concatenated_string"), "nothing"),
}


def _kind(name: str) -> int:
    return LANGUAGE.id_for_node_kind(name, True) or 0


_KINDS = {(_kind(name) if name != "ERROR" else 65535): method for name, method in _HANDLERS.items()}
_ASSIGNMENT = _kind("assignment")


class Statements(Control):
    """Lowers the statements of one file.

    Attributes:
        classes: of the file so far; None stands for one whose body is being read.
        imports: local names and what they mean, the first of each.
        using: modules that everything is imported from.
        modules: every imported module with its line.
    """

    def __init__(self, source: bytes) -> None:
        """Begin with the source that was parsed."""
        super().__init__(source)
        self.classes: list[Class | None] = []
        self.imports: dict[str, str] = {}
        self.using: list[str] = []
        self.modules: list[tuple[str, int]] = []
        self._owner = ""
        self._in_function = False
        self._decorators: tuple[Expression, ...] = ()
        self._run = {kind: getattr(self, f"_on_{method}") for kind, method in _KINDS.items()}

    def statements(self, node: Node) -> None:
        """Append the statements that stand in a node."""
        if self._depth >= DEEPEST:
            self._too_deep(node)
            return
        self._depth += 1
        run = self._run
        for child in node.children:
            if child.is_named:
                run.get(child.kind_id, self.evaluate)(child)
        self._depth -= 1

    def _on_inside(self, node: Node) -> None:
        self.statements(node)

    def _on_nothing(self, node: Node) -> None:
        """Skip statements without effect."""

    def _on_leave(self, node: Node) -> None:
        self.pending.append(Leave(node.type == "continue_statement", self.line(node)))

    # Simple statements

    def _on_alone(self, node: Node) -> None:
        for child in node.children:
            if child.is_named:
                self._run.get(child.kind_id, self.evaluate)(child)

    _on_parts_alone = _on_alone

    def _on_delete(self, node: Node) -> None:
        """Lower ``del of[key]`` as ``of.pop(key)``; names are forgotten by whoever reads them no more."""
        parts = self.parts(node)
        for part in self.parts(parts[0]) if parts and parts[0].type == "expression_list" else parts:
            item = self.expression(part)
            if isinstance(item, Item):
                line = self.line(node)
                self.pending.append(Evaluate(Call(Member(item.of, "pop"), (item.key,), line=line), line))

    def _on_assignment(self, node: Node) -> None:
        line = self.line(node)
        declared = self.squeezed(node.child_by_field_name("type"))
        targets = []
        right: Node | None = node
        while right is not None and right.kind_id == _ASSIGNMENT:
            left = right.child_by_field_name("left")
            if left is not None:
                targets.append(left)
            right = right.child_by_field_name("right")
        if right is None:
            self.pending += [Assign(self.expression(target), None, declared, line=line) for target in targets]
            return
        value = self.expression(right)
        for target in targets:
            place = self.expression(target)
            if not (isinstance(place, Sequence) and self._assign_each(target, right, place, value, line)):
                self.pending.append(Assign(place, value, declared, line=line))
            if isinstance(place, (Name, Member)):
                value = place

    def _assign_each(self, target: Node, right: Node, places: Sequence, values: Expression, line: int) -> bool:
        """Assign item by item where that is the same; return whether it is."""
        if not isinstance(values, Sequence) or len(values.items) != len(places.items):
            return False
        if not all(isinstance(place, (Name, Member)) for place in places.items):
            return False
        written = [set(_WORD.findall(self.source, one.start_byte, one.end_byte)) for one in (target, right)]
        if written[0] & written[1] - {b"self"}:
            return False
        self.pending += [
            Assign(place, value, line=line) for place, value in zip(places.items, values.items, strict=True)
        ]
        return True

    def _on_augmented(self, node: Node) -> None:
        children = node.children
        operator = self.text(children[1]) if len(children) == 3 else ""
        line = self.line(node)
        if operator != "+=" and operator[:-1] not in _KEPT_OPERATORS:
            opaque = self._opaque(node)
            self.pending.append(Assign(self.expression(children[0]), opaque, "", operator or "=", line))
            return
        target, value = self.expression(children[0]), self.expression(children[2])
        if operator == "+=" and children[2].type == "tuple":
            # Tuples are sequences as lists are; to a tuple one is added without changing it for its other names.
            self.pending.append(Assign(target, Operation("+", (target, value)), line=line))
        elif operator == "+=":
            self.pending.append(Assign(target, value, "", "+=", line))
        else:
            self.pending.append(Assign(target, Operation(operator[:-1], (target, value)), "", operator, line))

    def _on_return(self, node: Node) -> None:
        parts = self.parts(node)
        value = self.expression(parts[0]) if parts else None
        self.pending.append(Return(value, self.line(node)))

    def _on_global(self, node: Node) -> None:
        declared = node.type.partition("_")[0]
        self.pending += [
            Assign(Name(self.text(name)), None, declared, line=self.line(node)) for name in self.parts(node)
        ]

    # Imports

    def _on_import(self, node: Node) -> None:
        line = self.line(node)
        for part in self.parts(node):
            name, alias = self._imported(part)
            self.modules.append((name, line))
            root = name.partition(".")[0]
            self.imports.setdefault(alias or root, name if alias else root)

    def _on_import_from(self, node: Node) -> None:
        module = node.child_by_field_name("module_name")
        origin = "".join(self.text(module).split()) if module is not None else ""
        self.modules.append((origin, self.line(node)))
        prefix = origin if origin.endswith(".") or not origin else f"{origin}."
        for part in self.parts(node):
            if part == module:
                continue
            if part.type == "wildcard_import":
                self.using.append(origin)
                continue
            name, alias = self._imported(part)
            self.imports.setdefault(alias or name, prefix + name)

    def _on_future(self, node: Node) -> None:
        self.modules.append(("__future__", self.line(node)))

    def _imported(self, node: Node) -> tuple[str, str]:
        """Return the name and the alias of a part of an import."""
        name, alias = node.child_by_field_name("name"), node.child_by_field_name("alias")
        return "".join(self.text(name or node).split()), self.text(alias) if alias is not None else ""

    # Definitions

    def _on_decorated(self, node: Node) -> None:
        definition = node.child_by_field_name("definition")
        found = [self.parts(child) for child in self.parts(node) if child.type == "decorator"]
        decorators = [self.expression(parts[0]) for parts in found if parts]
        if definition is None:
            return
        self._decorators = tuple(decorators)
        if definition.type == "class_definition":
            self.pending += [Evaluate(one, self.line(node)) for one in decorators if isinstance(one, Call)]
        self._run.get(definition.kind_id, self.evaluate)(definition)
        self._decorators = ()

    def _on_function(self, node: Node) -> None:
        decorators, self._decorators = self._decorators, ()
        name = definition_name(node)
        name_node = node.child_by_field_name("name")
        line = self.line(name_node if name_node is not None else node)
        index = len(self.functions)
        self.functions.append(None)
        parameters = self.parameters(node.child_by_field_name("parameters"))
        owner, inside, scope, names, known = self._owner, self._in_function, self.scope, self._names, self._known
        qualified = f"{scope}.{name}" if scope else name
        if inside and not owner:
            self.pending.append(Assign(Name(name), Lambda(index), line=line))
        self.shadow(parameters)
        if owner:
            parameters = self._without_receiver(name, parameters, decorators)
        self._owner, self._in_function, self.scope = "", True, qualified
        body = self.block(node.child_by_field_name("body"))
        self._owner, self._in_function, self.scope, self._names, self._known = owner, inside, scope, names, known
        self.functions[index] = Function(name, qualified, line, owner, parameters, (), body, (), decorators)

    def _without_receiver(
        self, name: str, parameters: tuple[Parameter, ...], decorators: tuple[Expression, ...]
    ) -> tuple[Parameter, ...]:
        """Leave out the object or class that a method is called on, and name it as everywhere."""
        if Name("staticmethod") in decorators or not parameters or parameters[0].name.startswith("*"):
            return parameters
        meant = "cls" if Name("classmethod") in decorators or name in _CLASS_METHODS else "self"
        if parameters[0].name != meant:
            self._names = {**self._names, parameters[0].name: meant}
            self._known = {}
        return parameters[1:]

    def _on_class(self, node: Node) -> None:
        self._decorators = ()
        name = definition_name(node)
        qualified = f"{self.scope}.{name}" if self.scope else name
        index = len(self.classes)
        self.classes.append(None)
        bases = node.child_by_field_name("superclasses")
        if bases is not None:
            self._on_alone(bases)
        owner, scope = self._owner, self.scope
        self._owner = self.scope = qualified
        body = self.block(node.child_by_field_name("body"))
        self._owner, self.scope = owner, scope
        fields = []
        for statement in body:
            match statement:
                case Assign(target=Name(name=attribute)) if _is_field(statement):
                    fields.append(Field(attribute, statement.declared, statement.value, statement.line))
                case _:
                    self.pending.append(statement)
        self.classes[index] = Class(name, qualified, self.line(node), base_names(node), tuple(fields))


def _is_field(statement: Assign) -> bool:
    """Whether an assignment in the body of a class is one of an attribute, not of what a comprehension fills."""
    return (
        isinstance(statement.target, Name) and statement.operator == "=" and not statement.target.name.startswith("#")
    )
