"""One walk over the meaningful nodes of a C++ tree, with a stack instead of recursion.

The walk knows at any node which function and class it is in, how deep, whether in a condition or in a body, inside a
lambda, in a second or later arm of an ``#if``. What stands in a lambda counts for the function around it; a member
function of a local class is a function of its own.
"""

from __future__ import annotations

import re
from collections import defaultdict

from tree_sitter import Node

from roslens.source.syntax.cpp_names import (
    Declarator,
    base_names,
    friend_name,
    read_declarator,
    text_of,
    without_arguments,
)
from roslens.source.syntax.cpp_scopes import ClassScope, Frame, FunctionScope, Member
from roslens.source.syntax.facts import Control
from roslens.source.syntax.query.cpp_query import KINDS, Captures, Span

_LONGEST_NAME = 300
_IDENTIFIER = re.compile(rb"[A-Za-z_]\w*")
_OPENING, _CLOSING = b"( \t\r\n", b") \t\r\n"
_END_OF_HEADER = re.compile(rb"[;{=:]")
_SECTION = re.compile(rb"\w?\s*:(?!:)")
_DEFAULT_ACCESS = {"class_specifier": "private", "struct_specifier": "public", "union_specifier": "public"}
_CLASS_KINDS = {"class_specifier": "class", "struct_specifier": "struct", "union_specifier": "union"}
_HANDLERS = {
    **dict.fromkeys(("for", "while", "do", "switch", "try"), "_hold"),
    **dict.fromkeys(("case", "default", "ternary"), "_hold_body"),
    **dict.fromkeys(("return", "throw", "break", "continue", "goto", "label", "yield", "await"), "_leaf"),
    **dict.fromkeys(("and", "or"), "_logical"),
}
"""Kind to the method that handles it, where it is not named ``_on_<kind>``."""


class Walk:
    """The walk; after construction its attributes hold what was found.

    Attributes:
        functions: in source order; ``classes`` likewise.
        counts: of what stands outside functions.
        macro_calls: extents of the names of macros that hold a block inside a function, such as ``FOR_EACH(a, b) {``.
        macro_headers: extents of the arguments of macros that look like functions; they name no types.
    """

    def __init__(self, source: bytes, code: bytes, captures: Captures) -> None:
        """Walk over ``captures`` of ``source``; ``code`` is the same with its comments blanked."""
        self.functions: list[FunctionScope] = []
        self.classes: list[ClassScope] = []
        self.counts: defaultdict[str, int] = defaultdict(int)
        self.macro_calls: list[Span] = []
        self.macro_headers: list[Span] = []
        self._source = source
        self._code = code
        self._captures = captures
        self._top = Frame("file", len(source) + 1, None)
        self._run()

    def _run(self) -> None:
        stack = [self._top]
        for start, negative_end, kind in self._captures.events:
            top = stack[-1]
            while top.end <= start:
                stack.pop()
                top = stack[-1]
            self._top = top
            handle, role = _BY_KIND[kind]
            frame = handle(self, role, start, -negative_end)
            if frame is not None:
                stack.append(frame)

    # Control structure

    def _count(self, role: str) -> None:
        top = self._top
        scope = top.scope
        if scope is None:
            self.counts[role] += 1
            return
        scope.counts[role] += 1
        if top.in_lambda:
            scope.lambda_counts[role] += 1
        if top.alternative:
            scope.alternative_counts[role] += 1

    def _event(self, role: str, depth: int, part: str) -> None:
        self._count(role)
        top = self._top
        if top.scope is not None:
            top.scope.control.append(Control(role, depth, part, top.alternative))

    def _hold(self, role: str, _start: int, end: int) -> Frame:
        """Note an event that others stand in; they are in its condition until its body begins."""
        top = self._top
        self._event(role, top.depth, top.part)
        frame = Frame(role, end, top)
        frame.depth += 1
        frame.own_part = top.part
        frame.part = "body" if role in ("do", "try") else "condition"
        return frame

    def _hold_body(self, role: str, start: int, end: int) -> Frame:
        frame = self._hold(role, start, end)
        frame.part = "condition" if role == "ternary" else "body"
        return frame

    def _arm(self, role: str, end: int, part: str) -> Frame:
        """Note a further arm of the statement that the walk is in."""
        top = self._top
        self._event(role, max(0, top.depth - 1), top.own_part)
        frame = Frame(role, end, top)
        frame.own_part = top.own_part
        frame.part = part
        return frame

    def _leaf(self, role: str, _start: int, _end: int) -> None:
        self._event(role, self._top.depth, self._top.part)

    def _logical(self, role: str, start: int, end: int) -> Frame:
        top = self._top
        nested = top.role == "logical" and self._is_operand(start, end, top)
        depth = top.own_depth + 1 if nested else top.depth
        self._event(role, depth, top.part)
        frame = Frame("logical", end, top)
        frame.start = start
        frame.own_depth = depth
        frame.own_part = top.own_part
        return frame

    def _is_operand(self, start: int, end: int, outer: Frame) -> bool:
        """Return whether nothing but parentheses stands between a logical expression and the one around it."""
        first, last = self._captures.operators[outer.start, outer.end]
        if start < first:
            before, after = self._code[outer.start : start], self._code[end:first]
        else:
            before, after = self._code[last:start], self._code[end : outer.end]
        return not before.strip(_OPENING) and not after.strip(_CLOSING)

    def _on_part_body(self, _role: str, _start: int, _end: int) -> None:
        self._top.part = "body"

    def _on_part_condition(self, _role: str, _start: int, _end: int) -> None:
        self._top.part = "condition"

    def _on_if(self, role: str, start: int, end: int) -> Frame:
        if (start, end) in self._captures.else_ifs:
            return self._arm("elif", end, "condition")
        return self._hold(role, start, end)

    def _on_else(self, role: str, start: int, end: int) -> Frame | None:
        return None if (start, end) in self._captures.else_of_ifs else self._arm(role, end, "body")

    def _on_catch(self, role: str, _start: int, end: int) -> Frame:
        return self._arm(role, end, "body")

    def _on_lambda(self, role: str, start: int, end: int) -> Frame:
        frame = self._hold(role, start, end)
        frame.part = "body"
        scope = self._top.scope
        if scope is not None and not self._top.in_lambda:
            scope.lambdas.append((start, end))
        frame.in_lambda = True
        return frame

    def _on_preproc_if(self, role: str, start: int, _end: int) -> None:
        if self._top.scope is not None:
            self._count(role)
            if self._is_directive(start, b"ifndef"):
                self._count("preproc_ifndef")

    def _on_preproc_else(self, role: str, start: int, end: int) -> Frame:
        scope = self._top.scope
        if scope is not None:
            self._count(role)
            if self._is_directive(start, b"elif"):
                self._count("preproc_elif")
            if not self._top.alternative:
                scope.alternatives.append((start, end))
        frame = Frame(self._top.role if self._top.role != "logical" else "preproc_else", end, self._top)
        frame.own_part = self._top.own_part
        frame.alternative = True
        return frame

    def _is_directive(self, start: int, word: bytes) -> bool:
        written = self._source[start : start + 2 * len(word)]
        return written.removeprefix(b"#").lstrip(b" \t").startswith(word)

    # Definitions

    def _on_namespace(self, role: str, start: int, end: int) -> Frame:
        frame = Frame(role, end, self._top)
        node = self._captures.definitions["namespace"][start, end].child_by_field_name("name")
        if node is not None:
            name = without_arguments(self._text(node.start_byte, node.end_byte))
            frame.prefix = f"{frame.prefix}::{name}" if frame.prefix else name
        return frame

    def _on_class(self, role: str, start: int, end: int) -> Frame:
        top = self._top
        node = self._captures.definitions["class"][start, end]
        name_node = node.child_by_field_name("name") or _typedef_name(node)
        name = without_arguments(self._text(name_node.start_byte, name_node.end_byte)) if name_node else ""
        name = name or "(anonymous)"
        prefix = top.scope.qualified_name if top.scope is not None else top.prefix
        scope = ClassScope(
            name,
            prefix,
            _CLASS_KINDS[node.type],
            (start, end),
            base_names(node, self._source),
            _DEFAULT_ACCESS[node.type],
        )
        self.classes.append(scope)
        if top.scope is not None:
            top.scope.inner.append((start, end))
        frame = Frame(role, end, top)
        frame.prefix = scope.qualified_name
        frame.owner = scope
        frame.scope = None
        frame.in_lambda = frame.alternative = False
        frame.depth = 0
        return frame

    def _on_function(self, role: str, start: int, end: int) -> Frame:
        top = self._top
        node = self._captures.definitions["function"][start, end]
        declarator = read_declarator(node, self._source, top.owner.name if top.owner is not None else "")
        if declarator.macro:
            self.macro_headers.append((declarator.start, declarator.end))
            if top.scope is not None:
                self.macro_calls.append((declarator.start, declarator.start + declarator.name.index("(")))
                return Frame("block", end, top)
        owner = top.owner if top.role != "friend" else None
        scope = FunctionScope(declarator, (start, end), top.prefix, owner)
        head = self._source[start : min(declarator.start, start + _LONGEST_NAME)]
        scope.static = b"static" in head.split()
        scope.virtual = b"virtual" in head.split() or self._overrides(declarator, end)
        if top.scope is not None:
            top.scope.inner.append((start, end))
        self.functions.append(scope)
        frame = Frame(role, end, top)
        frame.scope = scope
        frame.owner = None
        frame.in_lambda = frame.alternative = False
        frame.depth = 0
        frame.part = frame.own_part = "body"
        if owner is not None:
            member = Member(owner.access, (start, declarator.end))
            member.declarator = declarator
            member.static = scope.static
            member.virtual = scope.virtual
            member.defined = True
            owner.members.append(member)
        return frame

    def _on_function_body(self, _role: str, start: int, end: int) -> None:
        top = self._top
        if top.role == "function" and top.scope is not None:
            top.scope.body = (start, end)

    def _overrides(self, declarator: Declarator, end: int) -> bool:
        """Return whether ``override`` or ``final`` stands behind the parameters."""
        tail = self._source[declarator.end : min(end, declarator.end + _LONGEST_NAME)]
        if b"override" not in tail and b"final" not in tail:
            return False
        words = _END_OF_HEADER.split(tail, maxsplit=1)[0].split()
        return b"override" in words or b"final" in words

    def _on_friend(self, role: str, start: int, end: int) -> Frame:
        """Note a friend; a function defined there is no member of the class."""
        top = self._top
        if top.owner is not None:
            node = self._captures.definitions["friend"][start, end]
            name = friend_name(node, self._source)
            if name:
                top.owner.friends.append(name)
        return Frame(role, end, top)

    def _on_field(self, _role: str, start: int, end: int) -> None:
        owner = self._top.owner
        if owner is None:
            return
        node = self._captures.definitions["field"][start, end]
        member = Member(owner.access, (start, end))
        if self._top.role == "friend":
            return
        declarators = node.children_by_field_name("declarator")
        first = declarators[0].start_byte if declarators else end
        head = self._source[start : min(first, start + _LONGEST_NAME)].split()
        member.static = b"static" in head
        for declarator in declarators:
            self._declare(owner, member, node, declarator)
        if member.declarator is not None:
            member.virtual = b"virtual" in head or self._overrides(member.declarator, end)
        if member.declarator is not None or member.names:
            owner.members.append(member)

    def _declare(self, owner: ClassScope, member: Member, node: Node, declared: Node) -> None:
        start, end = declared.byte_range
        written = self._source[start : min(end, start + _LONGEST_NAME)]
        if b"(" in written and declared.type != "field_identifier":
            declarator = read_declarator(node, self._source, owner.name)
            if declarator.name and not declarator.pointer:
                member.declarator = declarator
                return
            written = declarator.name.encode() if declarator.pointer else written
        name = _last_identifier(written)
        if name:
            member.names.append(name)

    def _on_access(self, _role: str, start: int, end: int) -> None:
        owner = self._top.owner
        # In front of a base class it is no section of the class.
        if owner is not None and _SECTION.match(self._source, end - 1):
            text = self._text(start, end).rstrip(": ")
            if text in ("public", "protected", "private"):
                owner.access = text

    def _text(self, start: int, end: int) -> str:
        return text_of(self._source[start : min(end, start + _LONGEST_NAME)])


_BY_KIND = [(getattr(Walk, _HANDLERS.get(name, f"_on_{name}")), name) for name in KINDS]
"""Number of a kind to what handles it and its name."""


def _typedef_name(definition: Node) -> Node | None:
    """Return where ``typedef struct { … } name;`` gives an anonymous class its name."""
    parent = definition.parent
    return parent.child_by_field_name("declarator") if parent is not None and parent.type == "type_definition" else None


def _last_identifier(declarator: bytes) -> str:
    """Return the name that a data member's declarator declares: ``*a[3]`` declares ``a``."""
    found = _IDENTIFIER.findall(declarator.partition(b"[")[0].partition(b"=")[0].partition(b"{")[0])
    return text_of(found[-1]) if found else ""
