"""What has been lowered of a C++ file so far, and where in it the lowering is."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.extract.ir.program import Class, Expression, Function, Name, Opaque, Operation, Program, Statement
from roslens.source.syntax.cpp_names import text_of

DEEPEST = 120
"""Nesting of expressions, statements and scopes; what is deeper is opaque, and the program incomplete there."""

_LONGEST_OPAQUE = 80
_SEVERAL = Opaque("one of several definitions")


class Lowered:
    """A program in the making.

    Attributes:
        source: the text that was parsed.
        scope: qualified name of the namespace, class or function around, joined by dots.
        class_name: qualified name of the class around; of a function that of its class.
        depth: how deep the lowering is nested.
        version: of ROS for which arms of conditions are compiled that ask for it; empty where all arms count.
        left_out: where the bodies of functions begin and end of which not all is lowered, in turn.
    """

    def __init__(self, source: bytes, version: str = "") -> None:
        """Begin with an empty program."""
        self.source = source
        self.version = version
        self.scope = ""
        self.class_name = ""
        self.depth = 0
        self._functions: list[Function | None] = []
        self.classes: list[Class | None] = []
        self.declarations: list[Function] = []
        self.body: list[Statement] = []
        self.macros: dict[str, Expression] = {}
        self.imports: dict[str, str] = {}
        self.using: list[str] = []
        self.includes: list[tuple[str, int]] = []
        self.incomplete: set[tuple[int, str]] = set()
        self.left_out: list[int] = []

    def text(self, node: Node) -> bytes:
        """Return the text of a node."""
        return self.source[node.start_byte : node.end_byte]

    def qualified(self, name: str) -> str:
        """Return ``name`` as seen from the file."""
        return f"{self.scope}.{name}" if self.scope else name

    def too_deep(self, node: Node) -> bool:
        """Return whether ``node`` is nested too deeply to be lowered; then it is noted."""
        if self.depth < DEEPEST:
            return False
        self.incomplete.add((node.start_point.row + 1, f"nested deeper than {DEEPEST}"))
        return True

    def begin_function(self) -> int:
        """Return the index of a function that follows: outer ones come before those in them."""
        self._functions.append(None)
        return len(self._functions) - 1

    def end_function(self, index: int, function: Function) -> None:
        """Fill in the function that was begun."""
        self._functions[index] = function

    def define_macro(self, name: str, value: Expression) -> None:
        """Add a macro; one that is defined differently under different conditions is a choice between them."""
        known = self.macros.get(name)
        if known == _SEVERAL or (isinstance(known, Operation) and known.operator == "?:"):
            value = _SEVERAL
        elif known is not None and known != value:
            value = Operation("?:", (Opaque("#if"), known, value))
        self.macros[name] = value

    def program(self) -> Program:
        """Return the program."""
        return Program(
            language="cpp",
            functions=tuple(one for one in self._functions if one is not None),
            classes=tuple(one for one in self.classes if one is not None),
            body=tuple(self.body),
            macros=self.macros,
            imports=self.imports,
            using=tuple(dict.fromkeys(self.using)),
            includes=tuple(self.includes),
            incomplete=tuple(sorted(self.incomplete)),
            declarations=tuple(self.declarations),
        )


def opaque(text: bytes) -> Opaque:
    """Return text of which no more is known."""
    return Opaque(" ".join(text_of(text[: 4 * _LONGEST_OPAQUE]).split())[:_LONGEST_OPAQUE])


def name_of(dotted: str) -> Name | Opaque:
    """Return a name; ``this`` is ``self``, and one that is missing in what does not parse is opaque."""
    if not dotted:
        return Opaque("")
    return Name("self" if dotted == "this" else dotted)
