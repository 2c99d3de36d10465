"""Functions, classes and calls of a Python file, and which functions an expression means.

A name means what its scope binds it to, whatever the order in which statements run. What cannot be followed means
nothing: parameters, attributes of unknown objects, values of calls other than ``partial``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

import msgspec
from tree_sitter import Language, Node, Query, QueryCursor

from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_parts import CONTAINERS, has_decorator, is_plain, items_of, parameter_names
from roslens.source.rules.flow.summary import Target

_DEEPEST = 8
_MOST = 24
"""Functions that one expression may mean; with more, nobody knows."""
_SCOPES = ("function_definition", "class_definition", "lambda")
_MOST_VALUES = 64
"""Expressions that a name may stand for, over all that they name."""


class PythonClass(msgspec.Struct, frozen=True, eq=False):
    """A class of the file.

    Attributes:
        node: its definition.
        name: of it.
        bases: as they are written.
        methods: the last definition of each name.
        attributes: what methods assign to attributes of ``self``, or the class to its own.
    """

    node: Node
    name: str
    bases: tuple[str, ...]
    methods: dict[str, Node]
    attributes: dict[str, list[Node]]


class PythonFunctions:
    """What a file defines and calls.

    Attributes:
        calls: all of them, in order.
        functions: that have a name, in order.
        classes: by name.
    """

    def __init__(self, view: FileView) -> None:
        """Collect definitions, assignments and calls of a file."""
        self._view = view
        self.calls: list[Node] = []
        self.functions: list[Node] = []
        self.classes: dict[str, PythonClass] = {}
        self._by_class: dict[int, PythonClass] = {}
        self._around: dict[int, Node | None] = {}
        self._nodes: dict[int, Node] = {}
        self._locals: dict[int, dict[str, list[Node]]] = {}
        self._calls_in: dict[int, list[Node]] = {}
        self._callees: dict[int, list[Node]] = {}
        self._defined: set[str] = set()
        self._globals: dict[int, set[str]] = {}
        self._meanings: dict[int, Sequence[Target]] = {}
        self._collect()

    def scope(self, node: Node) -> Node | None:
        """Return the innermost function, lambda or class around a node of this file; None for the module."""
        if node.id in self._around:
            return self._around[node.id]
        found = node.parent
        while found is not None and found.type not in ("function_definition", "lambda", "class_definition"):
            found = found.parent
        return found

    def class_around(self, node: Node) -> PythonClass | None:
        """Return the class to whose ``self`` code at a node belongs."""
        found = self.scope(node) if node.type != "class_definition" else node
        while found is not None and found.type != "class_definition":
            found = self._around.get(found.id)
        return self._by_class.get(found.id) if found is not None else None

    def calls_in(self, function: Node) -> Sequence[Node]:
        """Return the calls that a function makes itself, not those of functions in it."""
        return self._calls_in.get(function.id, ())

    def callees(self, function: Node) -> Sequence[Node]:
        """Return the functions of the file that a function calls."""
        known = self._callees.get(function.id)
        if known is None:
            known = self._callees[function.id] = []
            for call in self.calls_in(function):
                known.extend(one.function for one in self.called(call))
        return known

    def called(self, call: Node) -> Sequence[Target]:
        """Return the functions that a call may call; those of a class are its ``__init__``."""
        callee = call.child_by_field_name("function")
        if callee is None:
            return ()
        made = self.class_of_name(callee) if callee.type == "identifier" else None
        if made is not None:
            init = self.method(made, "__init__")
            return (Target(init, 1),) if init is not None else ()
        return self.meant(callee)

    def class_of_name(self, node: Node) -> PythonClass | None:
        """Return the class that a name means, unless something else has the name, too."""
        name = self._view.text(node)
        found = self.classes.get(name)
        return found if found is not None and len(self._bound(name, self.scope(node))) == 1 else None

    def method(self, of: PythonClass, name: str, depth: int = 0) -> Node | None:
        """Return a method of a class or of its bases in the file."""
        if name in of.methods:
            return of.methods[name]
        for base in of.bases if depth < _DEEPEST else ():
            inherited = self.classes.get(base)
            found = self.method(inherited, name, depth + 1) if inherited is not None and inherited is not of else None
            if found is not None:
                return found
        return None

    def attribute(self, of: PythonClass, name: str, depth: int = 0) -> Sequence[Node]:
        """Return what is assigned to an attribute in a class and its bases in the file."""
        found = list(of.attributes.get(name, ()))
        for base in of.bases if depth < _DEEPEST else ():
            inherited = self.classes.get(base)
            if inherited is not None and inherited is not of:
                found.extend(self.attribute(inherited, name, depth + 1))
        return found

    def defines(self, name: str) -> bool:
        """Return whether the file defines a function, method or class of a name."""
        return name in self.classes or name in self._defined

    def is_overridden(self, of: PythonClass, name: str) -> bool:
        """Return whether a class of the file that is derived from another has a method of its own of a name."""
        return any(one is not of and name in one.methods and self._derives(one, of) for one in self.classes.values())

    def _derives(self, one: PythonClass, of: PythonClass, depth: int = 0) -> bool:
        bases = [self.classes[each] for each in one.bases if each in self.classes]
        return depth < _DEEPEST and any(each is of or self._derives(each, of, depth + 1) for each in bases)

    def values(self, node: Node) -> Sequence[Node]:
        """Return the expressions that a name or an attribute of ``self`` is assigned; the node itself for others."""
        found: list[Node] = []
        seen: set[int] = set()
        waiting = [node]
        while waiting and len(seen) < _MOST_VALUES:
            one = waiting.pop()
            if one.id in seen:
                continue
            seen.add(one.id)
            if one.type == "identifier":
                waiting.extend(self._bound(self._view.text(one), self.scope(one)))
            elif one.type == "attribute" and self.is_self(one.child_by_field_name("object")):
                of = self.class_around(one)
                name = self._view.text(one.child_by_field_name("attribute"))
                waiting.extend(() if of is None else self.attribute(of, name))
            else:
                found.append(one)
        return found if not waiting else ()

    def is_self(self, node: Node | None) -> bool:
        """Tell whether an expression is the object of the method around it."""
        return node is not None and node.type == "identifier" and self._view.text(node) == "self"

    def meant(self, node: Node, depth: int = 0) -> Sequence[Target]:
        """Return the functions that an expression may mean; none where that cannot be followed."""
        known = self._meanings.get(node.id)
        if known is not None or depth > _DEEPEST:
            return known or ()
        # An expression that leads back to itself means nothing more there.
        self._meanings[node.id] = ()
        found: Sequence[Target] = list(self._meant(node, depth))
        if len(found) > _MOST:
            found = ()
        if len({one.function.id for one in found}) > 1:
            found = [Target(one.function, one.bound, one.keywords, is_exact=False) for one in found]
        self._meanings[node.id] = found
        return found

    def _meant(self, node: Node, depth: int) -> Iterator[Target]:
        match node.type:
            case "lambda" | "function_definition":
                yield Target(node, is_exact=is_plain(node, self._view))
            case "identifier":
                for one in self._bound(self._view.text(node), self.scope(node)):
                    yield from self.meant(one, depth + 1)
            case "attribute":
                yield from self._member(node, depth)
            case "call":
                yield from self._partial(node, depth)
            case "subscript":
                yield from self._any_item(node.child_by_field_name("value"), depth)
            case "conditional_expression" | "boolean_operator" | "parenthesized_expression":
                for one in node.named_children:
                    yield from self.meant(one, depth + 1)
            case "for_statement" | "for_in_clause":
                yield from self._item_of_loop(node, depth)

    def _member(self, node: Node, depth: int) -> Iterator[Target]:
        of, name = node.child_by_field_name("object"), self._view.text(node.child_by_field_name("attribute"))
        named = self.class_of_name(of) if of is not None and of.type == "identifier" else None
        if of is None:
            return
        if named is not None:
            yield from self._of_class(named, name)
            return
        for one in self.classes_of(of):
            method = self.method(one, name)
            if method is not None:
                plain = is_plain(method, self._view)
                yield Target(method, 0 if has_decorator(method, "staticmethod", self._view) else 1, is_exact=plain)
            elif self.is_self(of):
                yield from (each for value in self.attribute(one, name) for each in self.meant(value, depth + 1))

    def _of_class(self, named: PythonClass, name: str) -> Iterator[Target]:
        method = self.method(named, name)
        if method is not None:
            yield Target(method, 1 if has_decorator(method, "classmethod", self._view) else 0, is_exact=False)

    def classes_of(self, node: Node) -> Sequence[PythonClass]:
        """Return the classes of the file that an object may have."""
        if self.is_self(node):
            around = self.class_around(node)
            return () if around is None else (around,)
        if node.type == "call" and self._view.text(node.child_by_field_name("function")) == "super":
            around = self.class_around(node)
            bases = around.bases if around is not None else ()
            return [self.classes[one] for one in bases if one in self.classes]
        found = []
        for value in self.values(node):
            made = value.child_by_field_name("function") if value.type == "call" else None
            of = self.class_of_name(made) if made is not None and made.type == "identifier" else None
            if of is not None:
                found.append(of)
        return found

    def _partial(self, call: Node, depth: int) -> Iterator[Target]:
        if self._view.text(call.child_by_field_name("function")) not in ("partial", "functools.partial"):
            return
        listed = call.child_by_field_name("arguments")
        given = [one for one in listed.named_children if one.type != "comment"] if listed is not None else []
        names = {self._view.text(one.child_by_field_name("name")) for one in given if one.type == "keyword_argument"}
        placed = [one for one in given if one.type != "keyword_argument"]
        whole = not any(one.type.endswith("_splat") for one in given)
        for one in self.meant(placed[0], depth + 1) if placed else ():
            keywords = one.keywords | names
            yield Target(one.function, one.bound + len(placed) - 1, keywords, is_exact=one.is_exact and whole)

    def _any_item(self, container: Node | None, depth: int) -> Iterator[Target]:
        for one in self.values(container) if container is not None else ():
            for item in items_of(one):
                yield from self.meant(item, depth + 1)

    def _item_of_loop(self, loop: Node, depth: int) -> Iterator[Target]:
        right = loop.child_by_field_name("right")
        if right is None:
            return
        called = right.child_by_field_name("function") if right.type == "call" else None
        if called is not None and called.type == "attribute":
            right = called.child_by_field_name("object")
        for one in self.values(right) if right is not None else ():
            for item in items_of(one):
                for inner in items_of(item) if item.type in CONTAINERS else (item,):
                    yield from (
                        Target(each.function, each.bound, each.keywords, is_exact=False)
                        for each in self.meant(inner, depth + 1)
                    )

    def _bound(self, name: str, scope: Node | None) -> Sequence[Node]:
        """Return what a name is bound to where it is read: values, definitions, loops."""
        at = scope
        while at is not None:
            # The names of a class are not seen by its methods.
            if at.type != "class_definition" or at is scope:
                found = self._locals.get(at.id, {}).get(name)
                if found is not None:
                    return found
            at = self._around.get(at.id)
        return self._locals.get(0, {}).get(name, ())

    def _collect(self) -> None:
        captured = QueryCursor(_query()).captures(self._view.root)
        nodes = sorted((one for found in captured.values() for one in found), key=_order)
        stack: list[Node] = []
        for node in nodes:
            while stack and stack[-1].end_byte <= node.start_byte:
                stack.pop()
            around = stack[-1] if stack else None
            self._around[node.id] = around
            self._note(node, around)
            if node.type in _SCOPES:
                stack.append(node)

    def _note(self, node: Node, around: Node | None) -> None:
        at = around.id if around is not None else 0
        if node.type in _SCOPES:
            self._define(node, around)
        elif node.type == "global_statement":
            self._globals.setdefault(at, set()).update(self._view.text(one) for one in node.named_children)
        elif node.type == "call":
            self.calls.append(node)
            self._calls_in.setdefault(at, []).append(node)
        else:
            self._assign(node, around)

    def _define(self, node: Node, around: Node | None) -> None:
        name = self._view.text(node.child_by_field_name("name"))
        if node.type == "class_definition":
            listed = node.child_by_field_name("superclasses")
            bases = tuple(self._view.text(one) for one in listed.named_children) if listed is not None else ()
            of = PythonClass(node, name, bases, {}, {})
            self._by_class[node.id] = of
            self.classes.setdefault(name, of)
        elif node.type == "function_definition" and around is not None and around.type == "class_definition":
            self._by_class[around.id].methods[name] = node
        if node.type == "function_definition":
            self.functions.append(node)
        if name:
            self._defined.add(name)
            self._bind(name, node, around)
        for parameter in parameter_names(node):
            self._bind(self._view.text(parameter), parameter.parent or parameter, node)

    def _assign(self, node: Node, around: Node | None) -> None:
        left = node.child_by_field_name("left")
        loops = node.type in ("for_statement", "for_in_clause")
        value = node if loops else node.child_by_field_name("right")
        if left is None or value is None:
            return
        if left.type == "identifier":
            self._assign_name(left, value, around)
        elif left.type == "attribute":
            self._assign_attribute(left, value, around)
        else:
            for one in (each for each in left.named_children if each.type == "identifier"):
                self._bind(self._view.text(one), value if loops else one, around)

    def _assign_name(self, left: Node, value: Node, around: Node | None) -> None:
        name = self._view.text(left)
        self._bind(name, value, around)
        if around is not None and around.type == "class_definition":
            self._by_class[around.id].attributes.setdefault(name, []).append(value)

    def _assign_attribute(self, left: Node, value: Node, around: Node | None) -> None:
        of = self._class_of(around) if self.is_self(left.child_by_field_name("object")) else None
        if of is not None:
            of.attributes.setdefault(self._view.text(left.child_by_field_name("attribute")), []).append(value)

    def _class_of(self, scope: Node | None) -> PythonClass | None:
        while scope is not None and scope.type != "class_definition":
            scope = self._around.get(scope.id)
        return self._by_class.get(scope.id) if scope is not None else None

    def _bind(self, name: str, node: Node, scope: Node | None) -> None:
        at = scope.id if scope is not None else 0
        if name in self._globals.get(at, ()):
            at = 0
        self._locals.setdefault(at, {}).setdefault(name, []).append(node)


def python_functions(view: FileView) -> PythonFunctions:
    """Return the functions of a file, read when a rule first asks."""
    known = view.kept.get(PythonFunctions)
    if not isinstance(known, PythonFunctions):
        known = view.kept[PythonFunctions] = PythonFunctions(view)
    return known


@cache
def _query() -> Query:
    import tree_sitter_python

    language = Language(tree_sitter_python.language())
    kinds = (
        "function_definition",
        "class_definition",
        "lambda",
        "call",
        "assignment",
        "for_statement",
        "global_statement",
    )
    found: Query = Query(language, "".join(f"({one}) @{one}\n" for one in (*kinds, "for_in_clause")))
    return found


def _order(node: Node) -> tuple[int, int]:
    return node.start_byte, -node.end_byte
