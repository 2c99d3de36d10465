"""Facts of functions and classes, put together from what the walk over a Python tree collected."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence
from functools import lru_cache

from roslens.source.syntax.facts import (
    ClassFacts,
    Control,
    FieldFacts,
    FunctionFacts,
    Halstead,
    MethodFacts,
    SyntaxFault,
)
from roslens.source.syntax.python_lines import LineMap
from roslens.source.syntax.python_names import access_of, annotated, callee_name, is_class_like, text_of
from roslens.source.syntax.python_scopes import Attribute, ClassScope, Counts, Scope, Span
from roslens.source.syntax.python_walk import Walk
from roslens.source.syntax.query.python_query import Captures
from roslens.source.syntax.tokens import TokenText, halstead_of, word_counts

_SIMPLE_STATEMENTS = ("return", "throw", "break", "continue", "assert")
_IMPLICITLY_STATIC = frozenset({"__new__", "__init_subclass__", "__class_getitem__"})
_STATIC_DECORATORS = frozenset({"staticmethod", "classmethod"})
_DEEPEST = 20
"""Functions nested deeper are left without tokens and identifiers, which are looked for at every level again."""


class Assembly:
    """Turns what the walk collected into facts."""

    def __init__(
        self,
        source: bytes,
        text: TokenText,
        lines: LineMap,
        captures: Captures,
        walk: Walk,
        faults: Sequence[SyntaxFault],
    ) -> None:
        """Take what all entities of the file share."""
        self._source = source
        self._text = text
        self._lines = lines
        self._statements = captures.statements
        self._interpolations = captures.interpolations
        self._bound = frozenset(map(text_of, walk.bound)) | {found.name for found in walk.classes}
        self._fault_starts = [fault.line for fault in faults]
        self._fault_ends = [fault.end_line for fault in faults]
        self._names: dict[bytes, str] = {}
        self._class_like: set[str] = set()
        self._annotations: dict[bytes, frozenset[str]] = {}

    def halstead(self, start: int, end: int) -> Halstead:
        """Return Halstead's counts between two positions."""
        return halstead_of(self._text, word_counts(self._text, start, end), start, end)

    def counts(self, scope: Scope) -> dict[str, int]:
        """Return the counts of a function, or of the file outside functions, with its statements."""
        counts = _kept(scope.counts)
        statements = self._statements_in(scope.body) - sum(map(self._statements_in, _inner_bodies(scope)))
        statements += sum([counts[role] for role in _SIMPLE_STATEMENTS if role in counts])
        if statements:
            counts["statement"] = statements
        return counts

    def function(self, scope: Scope) -> FunctionFacts:
        """Return the facts of a function."""
        start, end = scope.span
        first, last = self._lines_of(scope.span)
        line_start = self._lines.start(first)
        measured = scope.level <= _DEEPEST
        calls = self._callees(scope.calls)
        parameter_types = self._annotated(scope.parameter_types)
        types = parameter_types | self._annotated(scope.types) | self._constructed(calls)
        method = scope.owner is not None
        approximate = self._is_approximate(first, last) or not measured
        return FunctionFacts(
            name=scope.name,
            qualified_name=scope.qualified_name,
            signature=", ".join(scope.parameters),
            line=first,
            column=start - line_start + 1,
            end_line=last,
            class_name=scope.owner.qualified_name if scope.owner else "",
            access=access_of(scope.name) if method else "",
            static=_is_static(scope),
            decorators=scope.decorators,
            parameters=len(scope.parameters) - _has_receiver(scope),
            nested_in=scope.nested_in,
            counts=self.counts(scope),
            lambda_counts=_kept(scope.lambda_counts),
            control=_in_steps(scope.control) if approximate else tuple(scope.control),
            lines=self._lines.lines(first, last),
            eloc=self._executed_lines(scope),
            halstead=self.halstead(start, end) if measured else Halstead(),
            parameter_types=tuple(sorted(parameter_types)),
            types=tuple(sorted(types)),
            calls=tuple(sorted(calls)),
            identifiers=self._identifiers(scope) if method else (),
            approximate=approximate,
            aside_counts=_kept(scope.aside_counts),
            header_counts=_kept(scope.header_counts),
        )

    def of_class(self, scope: ClassScope) -> ClassFacts:
        """Return the facts of a class."""
        start = scope.span[0]
        first, last = self._lines_of(scope.span)
        types = self._annotated(scope.types) | self._constructed(self._callees(scope.calls)) | set(scope.bases)
        for method in scope.methods:
            types |= self._annotated(method.parameter_types)
        return ClassFacts(
            name=scope.name,
            qualified_name=scope.qualified_name,
            kind="class",
            line=first,
            column=start - self._lines.start(first) + 1,
            end_line=last,
            bases=scope.bases,
            fields=tuple(map(self._field, scope.attributes.values())),
            methods=tuple(map(self._method, scope.methods)),
            types=tuple(sorted(types)),
            approximate=self._is_approximate(first, last),
        )

    def _field(self, attribute: Attribute) -> FieldFacts:
        name = text_of(attribute.name)
        types = self._annotated(attribute.types) | self._constructed(self._callees(attribute.calls))
        return FieldFacts(name, tuple(sorted(types)), access_of(name), attribute.shared)

    def _method(self, scope: Scope) -> MethodFacts:
        return MethodFacts(
            name=scope.name,
            signature=", ".join(scope.parameters),
            access=access_of(scope.name),
            line=self._lines.number(scope.span[0]),
            static=_is_static(scope),
            types=tuple(sorted(self._annotated(scope.parameter_types))),
            defined_here=True,
        )

    def _annotated(self, written: set[bytes]) -> set[str]:
        found: set[str] = set()
        for one in written:
            names = self._annotations.get(one)
            if names is None:
                names = self._annotations[one] = frozenset(annotated(one))
            found |= names
        return found

    def _constructed(self, calls: set[str]) -> set[str]:
        """Return the class-like names among callees."""
        return calls & self._class_like if self._class_like else set()

    def _callees(self, written: set[bytes]) -> set[str]:
        names = self._names
        found = set()
        for one in written:
            name = names.get(one)
            if name is None:
                name = names[one] = callee_name(one, self._bound)
                if is_class_like(name):
                    self._class_like.add(name)
            found.add(name)
        found.discard("")
        return found

    def _identifiers(self, scope: Scope) -> tuple[str, ...]:
        """Return the names that a method reaches through its object or class."""
        start, end = scope.span
        # Most methods name their class nowhere, so that few expressions serve all.
        named = tuple(one for one in scope.receivers if self._source.find(one.removesuffix(b"."), start, end) >= 0)
        if not named:
            return ()
        reached = _reached_through(named)
        found = set(reached.findall(self._text.code, *scope.body))
        spans = self._interpolations
        for inner_start, inner_end in spans[bisect_left(spans, (start, 0)) : bisect_left(spans, (end, 0))]:
            found.update(reached.findall(self._source, inner_start, inner_end))
        return tuple(sorted(map(text_of, found)))

    def _statements_in(self, span: Span) -> int:
        return bisect_left(self._statements, span[1]) - bisect_left(self._statements, span[0])

    def _lines_of(self, span: Span) -> tuple[int, int]:
        start, end = span
        return self._lines.number(start), self._lines.number(max(end - 1, start))

    def _executed_lines(self, scope: Scope) -> int:
        """Count the executed lines of a body; of functions defined in it, only those before their bodies."""
        count = self._lines.executed(*self._lines_of(scope.body))
        return count - sum(self._lines.executed(*self._lines_of(inner)) for inner in _inner_bodies(scope))

    def _is_approximate(self, first: int, last: int) -> bool:
        before = bisect_right(self._fault_starts, last)
        return before > 0 and self._fault_ends[before - 1] >= first


@lru_cache(maxsize=1000)
def _reached_through(receivers: tuple[bytes, ...]) -> re.Pattern[bytes]:
    names = b"|".join(re.escape(receiver.removesuffix(b".")) for receiver in receivers)
    return re.compile(rb"(?<![\w.])(?:" + names + rb")\s*\.\s*([A-Za-z_]\w*)")


def _inner_bodies(scope: Scope) -> list[Span]:
    """Return the bodies of functions defined in the body; a broken file may have some in the header."""
    start, end = scope.body
    return [inner.body for inner in scope.nested if start <= inner.body[0] and inner.body[1] <= end]


def _in_steps(control: Iterable[Control]) -> tuple[Control, ...]:
    """Return events of a broken function such that each has a parent."""
    settled: list[Control] = []
    deepest = 0
    for event in control:
        depth = min(event.depth, deepest)
        settled.append(Control(event.role, depth, event.part))
        deepest = depth + 1
    return tuple(settled)


def _kept(counts: Counts) -> dict[str, int]:
    return {role: count for role, count in counts.items() if count}


def _has_receiver(scope: Scope) -> bool:
    return scope.owner is not None and bool(scope.parameters) and "staticmethod" not in scope.decorators


def _is_static(scope: Scope) -> bool:
    if scope.owner is None:
        return False
    return not _STATIC_DECORATORS.isdisjoint(scope.decorators) or scope.name in _IMPLICITLY_STATIC
