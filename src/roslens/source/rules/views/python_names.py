"""The names of a Python file: which scope binds each to what, and where names are read that nothing binds.

Bindings are collected whatever the order in which statements run: a name that is bound anywhere in a scope is bound.
"""

from __future__ import annotations

import builtins
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from tree_sitter import Node

from roslens.source.rules.file_view import FileView

_BUILTINS = frozenset(dir(builtins)) | {
    "__file__", "__name__", "__doc__", "__path__", "__package__", "__spec__", "__loader__", "__annotations__",
    "__builtins__", "__class__", "WindowsError",
}  # fmt: skip
_SCOPES = frozenset({
    "module", "function_definition", "lambda", "class_definition", "list_comprehension", "set_comprehension",
    "dictionary_comprehension", "generator_expression",
})  # fmt: skip
_PLACES = frozenset({
    "pattern_list", "tuple_pattern", "list_pattern", "list_splat_pattern", "dictionary_splat_pattern",
    "as_pattern_target", "parenthesized_expression", "tuple", "list",
})  # fmt: skip
"""Nodes through which a target of an assignment leads to its names."""
_DYNAMIC = frozenset({"exec", "eval", "globals", "locals", "vars", "setattr", "__import__"})
"""Functions that bind names, or read them, in ways that nobody sees."""


class _Around(NamedTuple):
    """What stands around a node; to ask trees for parents takes as long as they are deep.

    Attributes:
        parent: of the node.
        annotates: the type of what the nearest annotation around it belongs to; empty where it stands in none.
        is_caught: whether something around it catches a ``NameError``.
        is_pattern: whether it stands in a pattern of ``match``.
    """

    parent: Node
    annotates: str = ""
    is_caught: bool = False
    is_pattern: bool = False

    def below(self, node: Node) -> _Around:
        """Return what stands around the children of a node around which this stands."""
        match node.type:
            case "type":
                return _Around(node, self.parent.type, self.is_caught, self.is_pattern)
            case "try_statement":
                return _Around(node, self.annotates, self.is_caught or _catches(node), self.is_pattern)
            case "case_pattern" | "type_parameter":
                return _Around(node, self.annotates, self.is_caught, is_pattern=True)
            case "block":
                return _Around(node, self.annotates, self.is_caught)
        return _Around(node, self.annotates, self.is_caught, self.is_pattern)


class Scope:
    """A module, function, class or comprehension.

    Attributes:
        node: of the tree.
        outer: the scope around it.
        bound: what each name is bound to: the value of a plain assignment, the node that binds it otherwise.
    """

    def __init__(self, node: Node, outer: Scope | None) -> None:
        """Begin without names."""
        self.node = node
        self.outer = outer
        self.bound: dict[str, list[Node]] = {}
        self.shared: set[str] = set()

    def bind(self, name: str, node: Node) -> None:
        """Note a binding; of a name that is declared global, it is one of the module."""
        scope: Scope = self
        if name in self.shared:
            while scope.outer is not None:
                scope = scope.outer
        scope.bound.setdefault(name, []).append(node)

    def finds(self, name: str) -> Scope | None:
        """Return the scope whose binding a name that is read here means; classes are seen from themselves alone."""
        scope: Scope | None = self
        while scope is not None:
            if name in scope.bound and (scope is self or scope.node.type != "class_definition"):
                return scope
            scope = scope.outer
        return None


class PythonNames:
    """The names of a file.

    Attributes:
        reads: identifiers that are read, each with its scope.
        is_open: names may come from a star import, or are bound by code that nobody sees.
        scopes: by the id of their node.
    """

    def __init__(self, root: Node) -> None:
        """Collect the bindings and reads below the root of a tree."""
        self.reads: list[tuple[Node, Scope]] = []
        self._by_name: dict[str, list[tuple[Node, Scope]]] = {}
        self.is_open = False
        self.evaluates_annotations = True
        self.module = Scope(root, None)
        self.scopes: dict[int, Scope] = {root.id: self.module}
        self._declare(root)
        self._annotating: set[int] = set()
        self._caught: set[int] = set()
        waiting = [(root, self.module, _Around(root))]
        while waiting:
            node, scope, around = waiting.pop()
            inside = around.below(node)
            waiting.extend((child, self._scope(child, scope, node), inside) for child in reversed(node.children))
            if node.type == "identifier":
                self._identifier(node, scope, around)
            else:
                self._visit(node, scope)

    def reads_of(self, name: str) -> Sequence[tuple[Node, Scope]]:
        """Return where a name is read, each place with its scope."""
        if not self._by_name:
            for node, scope in self.reads:
                self._by_name.setdefault(text_of(node), []).append((node, scope))
        return self._by_name.get(name, ())

    def unbound(self) -> Iterator[Node]:
        """Yield the names that are read and that nothing binds."""
        if self.is_open:
            return
        for node, scope in self.reads:
            if text_of(node) in _BUILTINS or scope.finds(text_of(node)) is not None or node.id in self._caught:
                continue
            if self.evaluates_annotations or node.id not in self._annotating:
                yield node

    def scope_of(self, node: Node) -> Scope:
        """Return the scope around a node."""
        found: Node | None = node
        while found is not None:
            if found.id in self.scopes and not _is_outside(node, found):
                return self.scopes[found.id]
            found = found.parent
        return self.module

    def _declare(self, root: Node) -> None:
        """Make all scopes, so that ``global`` counts wherever it stands in its function."""
        waiting: list[tuple[Node, Scope]] = [(root, self.module)]
        while waiting:
            node, scope = waiting.pop()
            if node.type in ("global_statement", "nonlocal_statement"):
                if node.type == "global_statement":
                    scope.shared.update(text_of(one) for one in node.children if one.type == "identifier")
                continue
            for child in node.children:
                if child.type in _SCOPES and child.id not in self.scopes:
                    self.scopes[child.id] = Scope(child, scope)
                waiting.append((child, self.scopes.get(child.id, scope)))

    def _scope(self, child: Node, scope: Scope, parent: Node) -> Scope:
        """Return the scope in which a child stands: defaults, decorators and names of definitions stand outside."""
        own = self.scopes.get(child.id)
        if own is not None and child.type not in ("function_definition", "class_definition", "lambda"):
            return own
        if child.type in ("function_definition", "class_definition", "lambda"):
            return scope
        inside = self.scopes.get(parent.id)
        if inside is not None and parent.type in ("function_definition", "class_definition", "lambda"):
            return inside if _is_inner(child, parent) else scope
        return _around_first(child, parent, scope)

    def _visit(self, node: Node, scope: Scope) -> None:
        match node.type:
            case "import_statement" | "import_from_statement" | "future_import_statement":
                self._import(node, scope)
            case "function_definition" | "class_definition" | "lambda":
                self._definition(node, scope)
            case "assignment" | "augmented_assignment" | "for_statement" | "for_in_clause":
                self._target(node.child_by_field_name("left"), node, scope)
            case "named_expression":
                self._target(node.child_by_field_name("name"), node, _not_comprehension(scope))
            case "as_pattern_target":
                self._target(node, node, scope)
            case "case_clause" | "type_alias_statement" | "type_parameter":
                for one in below_all(node):
                    if one.type == "identifier":
                        scope.bind(text_of(one), node)

    def _identifier(self, node: Node, scope: Scope, around: _Around) -> None:
        # The annotation of a local variable is never evaluated.
        is_never = around.annotates == "assignment" and scope.node.type == "function_definition"
        if is_never or around.is_pattern or not _is_read(node, around.parent):
            return
        self.reads.append((node, scope))
        if around.annotates:
            self._annotating.add(node.id)
        if around.is_caught:
            self._caught.add(node.id)
        if around.parent.type == "call" and text_of(node) in _DYNAMIC:
            self.is_open = True

    def _import(self, node: Node, scope: Scope) -> None:
        module = node.child_by_field_name("module_name")
        for one in node.children:
            if one.type == "wildcard_import":
                self.is_open = True
            elif node.type == "future_import_statement" and text_of(one) == "annotations":
                self.evaluates_annotations = False
            if one == module:
                continue
            if one.type == "aliased_import":
                scope.bind(text_of(one.child_by_field_name("alias")), one)
            elif one.type == "dotted_name":
                first = one.children[0] if node.type == "import_statement" else one
                scope.bind(text_of(first), one)

    def _definition(self, node: Node, scope: Scope) -> None:
        name = node.child_by_field_name("name")
        if name is not None:
            scope.bind(text_of(name), node)
        inner = self.scopes[node.id]
        parameters = node.child_by_field_name("parameters")
        for one in parameters.named_children if parameters is not None else ():
            name = one.child_by_field_name("name") if one.type.endswith("default_parameter") else one
            name = name.named_children[0] if name is not None and name.type == "typed_parameter" else name
            self._target(name, one, inner)

    def _target(self, node: Node | None, by: Node, scope: Scope) -> None:
        if node is None:
            return
        if node.type == "identifier":
            scope.bind(text_of(node), by)
        elif node.type in _PLACES:
            for one in node.named_children:
                self._target(one, node, scope)


def python_names(view: FileView) -> PythonNames:
    """Return the names of a file, collected when a rule first asks."""
    known = view.kept.get(PythonNames)
    if not isinstance(known, PythonNames):
        known = view.kept[PythonNames] = PythonNames(view.root)
    return known


def text_of(node: Node | None) -> str:
    """Return the text of a node; empty for none."""
    return "" if node is None or node.text is None else node.text.decode("utf-8", "replace")


def below_all(node: Node) -> Iterator[Node]:
    """Yield all nodes below a node."""
    waiting = list(node.children)
    while waiting:
        one = waiting.pop()
        yield one
        waiting.extend(one.children)


def above_of(node: Node, *types: str) -> Node | None:
    """Return the nearest node around ``node`` of one of the types, within its statement and those around it."""
    found = node.parent
    while found is not None and found.type not in types:
        found = found.parent
    return found


def _catches(node: Node) -> bool:
    """Whether a ``try`` catches a ``NameError``."""
    for clause in node.children:
        names = text_of(clause).partition(":")[0] if clause.type == "except_clause" else "-"
        if names.strip() == "except" or "NameError" in names or "Exception" in names:
            return True
    return False


def _around_first(child: Node, parent: Node, scope: Scope) -> Scope:
    """Return the scope of a node in a clause of a comprehension: what the first one goes through stands outside."""
    # Only then the parent: the parser finds it from the root of the tree on.
    if parent.type != "for_in_clause" or child != parent.child_by_field_name("right"):
        return scope
    holder = parent.parent
    if holder is None:
        return scope
    first = next((one for one in holder.children if one.type == "for_in_clause"), None)
    return scope.outer if first == parent and scope.outer is not None and scope.node == holder else scope


def _is_inner(child: Node, parent: Node) -> bool:
    return child == parent.child_by_field_name("body")


def _is_outside(node: Node, scope: Node) -> bool:
    """Whether a node stands in the heading of a definition, not in its body."""
    if scope.type not in ("function_definition", "class_definition", "lambda") or node == scope:
        return scope.type in ("function_definition", "class_definition", "lambda") and node == scope
    body = scope.child_by_field_name("body")
    return body is None or not body.start_byte <= node.start_byte < body.end_byte


def _not_comprehension(scope: Scope) -> Scope:
    while scope.outer is not None and scope.node.type.endswith(("comprehension", "generator_expression")):
        scope = scope.outer
    return scope


def _is_read(node: Node, parent: Node) -> bool:
    """Whether an identifier is a name that is read."""
    match parent.type:
        case "attribute":
            return parent.child_by_field_name("object") == node
        case "keyword_argument":
            return parent.child_by_field_name("name") != node
        case "dotted_name" | "aliased_import" | "global_statement" | "nonlocal_statement" | "keyword_pattern":
            return False
        case "function_definition" | "class_definition" | "named_expression":
            return parent.child_by_field_name("name") != node
        case "parameters" | "lambda_parameters" | "as_pattern_target" | "typed_parameter":
            return False
        case "default_parameter" | "typed_default_parameter":
            return parent.child_by_field_name("name") != node
        case "assignment" | "for_statement" | "for_in_clause":
            return parent.child_by_field_name("left") != node
        case "augmented_assignment":
            return True
        case _ if parent.type in _PLACES and parent.type not in ("parenthesized_expression", "tuple", "list"):
            return False
    return True
