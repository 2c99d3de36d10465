"""Of which message type an expression of a Python file is, where that is certain.

A variable has a type if all that it is assigned has it; the argument of a callback has that of the subscription or
service. What is imported under one name from several modules has none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.calls import arguments, function_around, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_callbacks import python_callbacks
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_parts import parameter_names
from roslens.source.rules.flow.summary import CallbackKind, Registration
from roslens.source.rules.signatures.read_messages import fields_of

_IMPORT = re.compile(
    rb"^[ \t]*from[ \t]+([a-z]\w*)\.(?:msg|srv)[ \t]+import[ \t]*(?:\(([^)]*)\)|([^\n#]*))", re.MULTILINE
)
_NAMED = re.compile(rb"(\w+)(?:\s+as\s+(\w+))?")
_PARTS = ("_Request", "_Response")
_PARAMETERS = ("parameters", "lambda_parameters", "typed_parameter")
"""What a name is bound to that is a parameter without a default."""
_DEEPEST = 6


class PythonMessages:
    """The types of messages that a file uses.

    Attributes:
        imported: by the name in the file, ``package/Name``.
    """

    def __init__(self, view: FileView) -> None:
        """Read the imports and callbacks of a file."""
        self._view = view
        self._functions = python_functions(view)
        self.imported: dict[str, str] = {}
        self._read_imports()
        self._parameters: dict[tuple[int, str], str] = {}
        self._read_callbacks()

    def _read_imports(self) -> None:
        twice: set[str] = set()
        for match in _IMPORT.finditer(self._view.code):
            for name in _NAMED.finditer(match[2] or match[3]):
                known = (name[2] or name[1]).decode()
                kind = f"{match[1].decode()}/{name[1].decode()}"
                if self.imported.setdefault(known, kind) != kind or self._functions.defines(known):
                    twice.add(known)
        for ambiguous in twice:
            del self.imported[ambiguous]

    def _read_callbacks(self) -> None:
        callbacks = python_callbacks(self._view)
        for one in callbacks.registrations if callbacks is not None else ():
            names = [self._view.text(name) for name in parameter_names(one.target.function)]
            for at, kind in enumerate(self._given(one), one.target.bound):
                if at < len(names):
                    key = one.target.function.id, names[at]
                    is_sure = one.target.is_exact and self._parameters.get(key, kind) == kind
                    self._parameters[key] = kind if is_sure else ""

    def _given(self, one: Registration) -> Iterator[str]:
        """Yield the types of what calls a callback gives it."""
        placed = arguments(one.call)
        named = keywords(one.call, self._view)
        kind = self.type_named(placed[0] if placed else named.get("msg_type", named.get("srv_type")))
        if one.is_ros1 or one.target.keywords or "raw" in named or not kind:
            yield from ("", "")
        elif one.kind is CallbackKind.SUBSCRIPTION:
            yield kind
        elif one.kind is CallbackKind.SERVICE:
            yield from (f"{kind}{part}" for part in _PARTS)

    def type_named(self, node: Node | None) -> str:
        """Return the type that the name of a class stands for; empty where it is none."""
        text = self._view.text(node)
        if text in self.imported:
            return self.imported[text]
        package, _, name = text.rpartition(".msg.")
        return f"{package}/{name}" if package.isidentifier() and name.isidentifier() else ""

    def type_of(self, node: Node | None, depth: int = 0) -> str:
        """Return the type of an expression; empty where it is not certain, or is no message whose fields are known."""
        if node is None or depth > _DEEPEST:
            return ""
        if node.type == "call":
            kind = self._made(node)
        elif node.type == "identifier":
            kind = self._of_name(node, depth)
        elif node.type == "attribute":
            kind = self._of_attribute(node, depth)
        else:
            return ""
        return kind if fields_of(kind) is not None else ""

    def _made(self, call: Node) -> str:
        callee = call.child_by_field_name("function")
        kind = self.type_named(callee)
        if kind:
            return kind
        service, _, part = self._view.text(callee).rpartition(".")
        return f"{self.imported[service]}_{part}" if service in self.imported else ""

    def _of_name(self, node: Node, depth: int) -> str:
        values = self._functions.values(node)
        function = function_around(node)
        if function is not None and len(values) == 1 and values[0].type in _PARAMETERS:
            return self._parameters.get((function.id, self._view.text(node)), "")
        return self._common(node, depth)

    def _of_attribute(self, node: Node, depth: int) -> str:
        of = node.child_by_field_name("object")
        if self._functions.is_self(of):
            return self._common(node, depth)
        fields = fields_of(self.type_of(of, depth + 1))
        return fields.types.get(self._view.text(node.child_by_field_name("attribute")), "") if fields else ""

    def _common(self, node: Node, depth: int) -> str:
        """Return the type that all values of a variable have."""
        kinds = {self.type_of(one, depth + 1) if one.type == "call" else "" for one in self._functions.values(node)}
        return kinds.pop() if len(kinds) == 1 else ""


def python_messages(view: FileView) -> PythonMessages:
    """Return the message types of a file, read when a rule first asks."""
    known = view.kept.get(PythonMessages)
    if not isinstance(known, PythonMessages):
        known = view.kept[PythonMessages] = PythonMessages(view)
    return known
