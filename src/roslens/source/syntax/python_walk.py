"""One walk over the meaningful nodes of a Python tree, with a stack instead of recursion.

The walk knows at any node which function it is in, how deep, whether in a condition or in a body, and what counts
for whom:

- decorators, defaults and annotations of a function are evaluated where it is defined and count there;
- the body of a class counts for the function or the file that the class stands in;
- what stands in a function that is defined inside another one counts for the inner one alone.
"""

from __future__ import annotations

import re

from roslens.source.syntax.facts import Control
from roslens.source.syntax.python_names import base_names, decorator_name, definition_name, parameter_names
from roslens.source.syntax.python_scopes import Attribute, ClassScope, Frame, Place, Scope
from roslens.source.syntax.query.python_query import KINDS, Captures

_LONGEST_CALLEE = 200
_IRREFUTABLE = re.compile(
    rb"case\b[\s(]*(?!(?:True|False|None)\b)[A-Za-z_\x80-\xff][\w\x80-\xff]*(?:\s+as\s+[\w\x80-\xff]+)?[\s)]*:"
)
_EXCEPT_GROUP = re.compile(rb"except\s*\*")
_BLANK = re.compile(rb"(?:[\s\\]|#[^\n]*)*")
_ELSE_ROLES = {"if": "else", "for": "loop_else", "while": "loop_else", "try": "try_else"}
_HANDLERS = {
    **dict.fromkeys(("if", "for", "while", "try", "with", "switch"), "_hold"),
    **dict.fromkeys(("elif", "finally"), "_arm"),
    **dict.fromkeys(("return", "throw", "break", "continue", "yield", "await"), "_leaf"),
    **dict.fromkeys(("and", "or"), "_logical"),
    **dict.fromkeys(("ternary_if", "ternary_else"), "_ternary_part"),
}
"""Kind to the method that handles it, where it is not named ``_on_<kind>``."""


class Walk:
    """The walk; after construction its attributes hold what was found.

    Attributes:
        file: what stands outside functions.
        functions: in source order; ``classes`` likewise.
        imports: text and position of every imported module.
        bound: names that imports bind.
    """

    def __init__(self, source: bytes, captures: Captures) -> None:
        """Walk over ``captures`` of ``source``."""
        self.file = Scope("", "", (0, len(source)), inner=False, body=(0, len(source)))
        self.functions: list[Scope] = []
        self.classes: list[ClassScope] = []
        self.imports: list[tuple[bytes, int]] = []
        self.bound: set[bytes] = set()
        self._source = source
        self._captures = captures
        self._decorators: list[str] = []
        self._attribute: Attribute | None = None
        self._type_end = 0
        place = Place(self.file, (self.file.counts,), self.file.types, self.file.calls)
        self._top = Frame("file", len(source) + 1, 0, "body", "body", place)
        self._run()

    def _run(self) -> None:
        handlers = [(getattr(self, _HANDLERS.get(name, f"_on_{name}")), name) for name in KINDS]
        stack = [self._top]
        for start, negative_end, kind in self._captures.events:
            top = stack[-1]
            while top.end <= start:
                stack.pop()
                top = stack[-1]
            self._top = top
            handle, role = handlers[kind]
            frame = handle(role, start, -negative_end)
            if frame is not None:
                stack.append(frame)

    # Events of the control structure

    def _event(self, role: str, depth: int, part: str) -> None:
        place = self._top.place
        for counts in place.sinks:
            counts[role] += 1
        if place.scope.inner:
            place.scope.control.append(Control(role, depth, part))

    def _hold(self, role: str, _start: int, end: int) -> Frame:
        """Note an event that others stand in; they are in its condition until its block begins."""
        top = self._top
        self._event(role, top.depth, top.part)
        return Frame(role, end, top.depth + 1, "condition", top.part, top.place)

    def _arm(self, role: str, _start: int, end: int) -> Frame:
        """Note a further arm of the statement that the walk is in."""
        top = self._top
        self._event(role, top.depth - 1 if top.depth else 0, top.own_part)
        return Frame(role, end, top.depth, "condition", top.own_part, top.place)

    def _on_catch(self, role: str, start: int, end: int) -> Frame:
        if _EXCEPT_GROUP.match(self._source, start):
            for counts in self._top.place.sinks:
                counts["catch_group"] += 1
        return self._arm(role, start, end)

    def _leaf(self, role: str, _start: int, _end: int) -> None:
        self._event(role, self._top.depth, self._top.part)

    def _logical(self, role: str, start: int, end: int) -> Frame:
        top = self._top
        depth = top.own_depth + 1 if self._is_operand(start, end) else top.depth
        self._event(role, depth, top.part)
        frame = Frame("logical", end, top.depth, top.part, top.own_part, top.place)
        frame.own_depth = depth
        frame.left = start, self._captures.operators[start, end][0]
        frame.right = self._captures.operators[start, end][1], end
        return frame

    def _on_parentheses(self, _role: str, start: int, end: int) -> Frame | None:
        """Enter parentheses where they are an operand of ``and`` or ``or``."""
        top = self._top
        if not self._is_operand(start, end):
            return None
        frame = Frame("logical", end, top.depth, top.part, top.own_part, top.place)
        frame.own_depth = top.own_depth
        frame.left = frame.right = start + 1, end - 1
        return frame

    def _is_operand(self, start: int, end: int) -> bool:
        """Whether a node is all there is on one side of the ``and`` or ``or`` that the walk is in."""
        top = self._top
        if top.role != "logical":
            return False
        return any(
            _BLANK.fullmatch(self._source, side_start, start) and _BLANK.fullmatch(self._source, end, side_end)
            for side_start, side_end in (top.left, top.right)
        )

    def _on_else_arm(self, _role: str, start: int, end: int) -> Frame:
        return self._arm(_ELSE_ROLES.get(self._top.role, "else"), start, end)

    def _on_case(self, _role: str, start: int, end: int) -> Frame:
        irrefutable = _IRREFUTABLE.match(self._source, start, end)
        return self._hold("default" if irrefutable else "case", start, end)

    def _on_if_clause(self, _role: str, start: int, end: int) -> Frame:
        role = "guard" if self._top.role in {"case", "default"} else "comprehension_if"
        return self._hold(role, start, end)

    def _on_comprehension(self, role: str, start: int, end: int) -> Frame:
        frame = self._hold(role, start, end)
        frame.part = "body"
        return frame

    def _on_comprehension_for(self, role: str, start: int, end: int) -> Frame:
        """Enter a ``for``: the first one is the comprehension's own, the others are events inside it."""
        top = self._top
        if top.role == "comprehension":
            top.role = "comprehension_rest"
            return Frame(role, end, top.depth, "condition", top.own_part, top.place)
        return self._hold("comprehension", start, end)

    def _on_ternary(self, role: str, start: int, end: int) -> Frame:
        frame = self._hold(role, start, end)
        frame.part = "body"
        return frame

    def _ternary_part(self, name: str, _start: int, _end: int) -> None:
        self._top.part = "condition" if name == "ternary_if" else "body"

    def _on_lambda(self, role: str, start: int, end: int) -> Frame:
        frame = self._hold(role, start, end)
        frame.part = "body"
        frame.place = frame.place.inside_lambda()
        return frame

    def _on_assert(self, role: str, start: int, end: int) -> Frame:
        self._leaf(role, start, end)
        top = self._top
        return Frame(role, end, top.depth, top.part, top.own_part, top.place.set_aside())

    # Definitions

    def _on_block(self, _role: str, start: int, end: int) -> None:
        top = self._top
        if top.role == "function":
            scope = top.defines
            scope.body = (start, end)
            top.role = "body"
            top.depth = 0
            top.place = Place(scope, (scope.counts,), scope.types, scope.calls)
        elif top.role != "class":
            top.part = "body"

    def _on_decorator(self, role: str, start: int, end: int) -> Frame:
        self._decorators.append(decorator_name(self._source[start : min(end, start + _LONGEST_CALLEE)]))
        top = self._top
        return Frame(role, end, top.depth, top.part, top.own_part, top.place.set_aside())

    def _on_function(self, role: str, start: int, end: int) -> Frame:
        top = self._top
        place = top.place
        if place.scope.inner:
            self._event(role, top.depth, top.part)
        scope = self._new_function(start, end)
        place.scope.nested.append(scope)
        header = place.set_aside()
        sinks = (*header.sinks, scope.header_counts)
        header = Place(place.scope, sinks, scope.parameter_types, place.calls, None, header.aside, place.in_lambda)
        frame = Frame(role, end, top.depth, top.part, "body", header)
        frame.defines = scope
        self.functions.append(scope)
        return frame

    def _new_function(self, start: int, end: int) -> Scope:
        place = self._top.place
        node = self._captures.definitions[start, end]
        name = definition_name(node)
        scope = Scope(name, self._qualified(name), (start, end), body=(end, end))
        scope.nested_in = place.scope.qualified_name
        scope.level = place.scope.level + place.scope.inner
        scope.decorators = self._take_decorators()
        scope.parameters = parameter_names(node)
        if place.owner is None:
            scope.own_calls = frozenset({name.encode()})
            scope.receivers = place.scope.receivers
            scope.field_owner = place.scope.field_owner
        else:
            scope.owner = scope.field_owner = place.owner
            place.owner.methods.append(scope)
            receivers = {place.owner.name, *([] if "staticmethod" in scope.decorators else scope.parameters[:1])}
            scope.receivers = tuple(f"{receiver}.".encode() for receiver in sorted(receivers))
            scope.own_calls = frozenset(receiver + name.encode() for receiver in scope.receivers)
        return scope

    def _on_class(self, role: str, start: int, end: int) -> Frame:
        top = self._top
        place = top.place
        node = self._captures.definitions[start, end]
        name = definition_name(node)
        scope = ClassScope(name, self._qualified(name), (start, end), base_names(node))
        self._take_decorators()
        self.classes.append(scope)
        aside = place.set_aside()
        body = Place(place.scope, aside.sinks, scope.types, scope.calls, scope, aside.aside, place.in_lambda)
        return Frame(role, end, top.depth, top.part, top.own_part, body)

    def _qualified(self, name: str) -> str:
        place = self._top.place
        outer = place.owner.qualified_name if place.owner else place.scope.qualified_name
        return f"{outer}.{name}" if outer else name

    def _take_decorators(self) -> tuple[str, ...]:
        taken, self._decorators = tuple(self._decorators), []
        return taken

    # Simple statements and expressions

    def _on_callee(self, _role: str, start: int, end: int) -> None:
        place = self._top.place
        written = self._source[max(start, end - _LONGEST_CALLEE) : end]
        place.calls.add(written)
        recursive = written in place.scope.own_calls
        for counts in place.sinks:
            counts["call"] += 1
            if recursive:
                counts["recursion"] += 1

    def _on_type(self, _role: str, start: int, end: int) -> None:
        if start >= self._type_end:
            self._type_end = end
            self._top.place.types.add(self._source[start:end])

    def _on_class_attribute(self, _role: str, start: int, end: int) -> None:
        self._attribute = None
        owner = self._top.place.owner
        if owner is not None:
            name = self._source[start:end]
            self._attribute = owner.attributes.setdefault(name, Attribute(name, shared=True))

    def _on_self_attribute(self, _role: str, start: int, end: int) -> None:
        self._attribute = None
        scope = self._top.place.scope
        owner = scope.field_owner
        written = self._source[start:end]
        if owner is not None and written.startswith(scope.receivers):
            receiver, _, name = written.partition(b".")
            if b"." in name:
                return
            shared = receiver == owner.name.encode()
            self._attribute = owner.attributes.setdefault(name, Attribute(name, shared))
            self._attribute.shared &= shared

    def _on_field_type(self, _role: str, start: int, end: int) -> None:
        if self._attribute is not None:
            self._attribute.types.add(self._source[start:end])

    def _on_field_constructor(self, _role: str, start: int, end: int) -> None:
        if self._attribute is not None:
            self._attribute.calls.add(self._source[start:end])

    def _on_import(self, _role: str, start: int, end: int) -> None:
        written = self._source[start:end]
        self.imports.append((written, start))
        self.bound.add(written.partition(b".")[0])

    def _on_bound(self, _role: str, start: int, end: int) -> None:
        self.bound.add(self._source[start:end])

    def _on_future_import(self, _role: str, start: int, _end: int) -> None:
        self.imports.append((b"__future__", start))
