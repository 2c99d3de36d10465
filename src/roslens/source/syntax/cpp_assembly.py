"""Facts of functions and classes, put together from what the walk over a C++ tree collected."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Mapping, Sequence

from roslens.source.syntax.cpp_lines import LineMap
from roslens.source.syntax.cpp_names import callee_name, text_of
from roslens.source.syntax.cpp_query import Captures, Span
from roslens.source.syntax.cpp_walk import ClassScope, FunctionScope, Member, Walk
from roslens.source.syntax.facts import (
    ClassFacts,
    FieldFacts,
    FunctionFacts,
    Halstead,
    MethodFacts,
    SyntaxFault,
)
from roslens.source.syntax.tokens import NO_NAMES, TokenText, halstead_of, word_counts

_LONGEST_NAME = 300
_SCOPE = frozenset(b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_:")
_LETTERS = frozenset(b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_")


def _between(spans: list[Span], start: int, end: int) -> list[Span]:
    """Return those of the sorted ``spans`` that begin from ``start`` to before ``end``."""
    return spans[bisect_left(spans, (start, 0)) : bisect_left(spans, (end, 0))]


def _outside(spans: list[Span], areas: list[Span]) -> list[Span]:
    """Return those of the sorted ``spans`` that begin in none of ``areas``."""
    kept, done = [], 0
    for start, end in sorted(areas):
        place = bisect_left(spans, (start, 0))
        kept += spans[done:place]
        done = max(done, bisect_left(spans, (end, 0)))
    return kept + spans[done:]


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
        self._text = text
        self._lines = lines
        self._statements = captures.statements
        self._fault_starts = [fault.line for fault in faults]
        self._fault_ends = [fault.end_line for fault in faults]
        self._names: dict[bytes, str] = {}
        self._callees: dict[bytes, str] = {}
        self._walk = walk
        self._source = source
        self._called_at = sorted([*captures.callees, *walk.macro_calls])
        self._typed_at = _outside(captures.types, walk.macro_headers)
        self._bodies = sorted(scope.body for scope in walk.functions)

    def function(self, scope: FunctionScope) -> FunctionFacts:
        """Return the facts of a function."""
        start, end = scope.span
        first, last = self._lines.number(start), self._lines.number(end - 1)
        words = word_counts(self._text, start, end)
        declarator = scope.declarator
        counts = dict(scope.counts)
        called = self._callees_in(scope)
        if called:
            counts["call"] = len(called)
            if recursions := called.count(declarator.name.encode()):
                counts["recursion"] = recursions
        if statements := self._within(scope.body) - sum(map(self._within, scope.inner)):
            counts["statement"] = statements
        body_first, body_last = self._lines.number(scope.body[0]), self._lines.number(scope.body[1] - 1)
        return FunctionFacts(
            name=declarator.name or "(unnamed)",
            qualified_name=scope.qualified_name or "(unnamed)",
            signature=declarator.signature,
            line=first,
            column=start - self._lines.start(first) + 1,
            end_line=last,
            class_name=scope.class_name,
            access=scope.access,
            static=scope.static,
            virtual=scope.virtual,
            parameters=declarator.parameters,
            counts=counts,
            lambda_counts=self._with_calls(scope.lambda_counts, scope.lambdas, scope.inner),
            alternative_counts=self._with_calls(scope.alternative_counts, scope.alternatives, scope.inner),
            control=tuple(scope.control),
            lines=self._lines.lines(first, last),
            eloc=max(0, self._eloc(scope.body, body_first, body_last) - self._inner_lines(scope)),
            halstead=halstead_of(self._text, words, start, end),
            parameter_types=self._types_in(start, scope.body[0]),
            types=self._types_in(start, end),
            calls=self._called(called),
            identifiers=self._identifiers(scope) if scope.class_name else (),
            approximate=self._is_approximate(first, last),
        )

    def of_class(self, scope: ClassScope) -> ClassFacts:
        """Return the facts of a class."""
        start, end = scope.span
        first, last = self._lines.number(start), self._lines.number(end - 1)
        fields = tuple(
            FieldFacts(name, self._types_in(*member.span), member.access, member.static)
            for member in scope.members
            if member.declarator is None
            for name in member.names
        )
        return ClassFacts(
            name=scope.name,
            qualified_name=scope.qualified_name,
            kind=scope.kind,
            line=first,
            column=start - self._lines.start(first) + 1,
            end_line=last,
            bases=scope.bases,
            fields=fields,
            methods=tuple(self._method(member) for member in scope.members if member.declarator is not None),
            types=self._types_outside_bodies(start, end),
            friends=tuple(sorted(set(scope.friends))),
            approximate=self._is_approximate(first, last),
        )

    def counts(self) -> dict[str, int]:
        """Return the counts of what stands outside functions."""
        counts = dict(self._walk.counts)
        inside = sum(len(_between(self._called_at, *scope.span)) for scope in self._walk.functions)
        nested = sum(len(_between(self._called_at, *span)) for scope in self._walk.functions for span in scope.inner)
        if calls := len(self._called_at) - inside + nested:
            counts["call"] = calls
        return counts

    def halstead(self) -> Halstead:
        """Return Halstead's counts of the whole file."""
        return halstead_of(self._text, word_counts(self._text))

    def _method(self, member: Member) -> MethodFacts:
        declarator = member.declarator
        name, signature = (declarator.name, declarator.signature) if declarator else ("", "")
        return MethodFacts(
            name=name,
            signature=signature,
            access=member.access,
            line=self._lines.number(member.span[0]),
            static=member.static,
            virtual=member.virtual,
            types=self._types_in(*member.span),
            defined_here=member.defined,
        )

    def _eloc(self, body: Span, first: int, last: int) -> int:
        if first == last:
            return 1 if self._within(body) else 0
        count = self._lines.executed(first, last)
        # The line of the opening brace may belong to the header, which is not executed.
        opening = self._lines.executed(first, first)
        begun = bisect_left(self._statements, body[0])
        on_it = begun < len(self._statements) and self._lines.number(self._statements[begun]) == first
        return count - opening + (1 if opening and on_it else 0)

    def _inner_lines(self, scope: FunctionScope) -> int:
        """Return how many executed lines hold only what is inside local classes."""
        if not scope.inner:
            return 0
        first, last = scope.body
        own = {
            self._lines.number(start)
            for start in self._statements[bisect_left(self._statements, first) : bisect_left(self._statements, last)]
            if not any(begin <= start < end for begin, end in scope.inner)
        }
        inside: set[int] = set()
        for begin, end in scope.inner:
            inside.update(range(self._lines.number(begin), self._lines.number(end - 1) + 1))
        return sum(self._lines.executed(line, line) for line in inside - own)

    def _within(self, span: Span) -> int:
        return bisect_left(self._statements, span[1]) - bisect_left(self._statements, span[0])

    def _callees_in(self, scope: FunctionScope) -> list[bytes]:
        """Return what is called in a function, as written."""
        source = self._source
        spans = _between(self._called_at, *scope.span)
        for first, last in scope.inner:
            spans = [span for span in spans if not first <= span[0] < last]
        return [source[max(start, end - _LONGEST_NAME) : end] for start, end in spans]

    def _with_calls(self, counts: Mapping[str, int], spans: Sequence[Span], inner: Sequence[Span]) -> dict[str, int]:
        """Return counts with the calls inside ``spans`` and outside ``inner``."""
        found = dict(counts)
        called = (start for span in spans for start, _ in _between(self._called_at, *span))
        if calls := sum(1 for start in called if not any(first <= start < last for first, last in inner)):
            found["call"] = calls
        return found

    def _types_in(self, start: int, end: int) -> tuple[str, ...]:
        return tuple(sorted({self._type(*span) for span in _between(self._typed_at, start, end)}))

    def _types_outside_bodies(self, start: int, end: int) -> tuple[str, ...]:
        spans = _between(self._typed_at, start, end)
        bodies = _between(self._bodies, start, end)
        outside = (span for span in spans if not any(first <= span[0] < last for first, last in bodies))
        return tuple(sorted({self._type(*span) for span in outside}))

    def _type(self, start: int, end: int) -> str:
        source = self._source
        if source[start - 2 : start] == b"::":
            first = start
            while first > 0 and start - first < _LONGEST_NAME and source[first - 1] in _SCOPE:
                first -= 1
            return self._name(source[first:end].lstrip(b":"))
        return self._name(source[start:end])

    def _name(self, written: bytes) -> str:
        known = self._names.get(written)
        if known is None:
            known = self._names[written] = text_of(written)
        return known

    def _called(self, written: Iterable[bytes]) -> tuple[str, ...]:
        found = set()
        for one in written:
            name = self._callees.get(one)
            if name is None:
                name = self._callees[one] = callee_name(text_of(one))
            found.add(name)
        found.discard("")
        return tuple(sorted(found))

    def _identifiers(self, scope: FunctionScope) -> tuple[str, ...]:
        words = word_counts(self._text, *scope.body).keys() - NO_NAMES
        return tuple(sorted(self._name(word) for word in words if word[0] in _LETTERS))

    def _is_approximate(self, first: int, last: int) -> bool:
        before = bisect_right(self._fault_starts, last)
        return before > 0 and self._fault_ends[before - 1] >= first
