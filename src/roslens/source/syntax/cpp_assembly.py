"""Facts of functions and classes, put together from what the walk over a C++ tree collected."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Generic, TypeVar

from roslens.source.syntax.cpp_lines import LineMap
from roslens.source.syntax.cpp_names import callee_name, text_of
from roslens.source.syntax.cpp_scopes import ClassScope, FunctionScope, Member
from roslens.source.syntax.cpp_walk import Walk
from roslens.source.syntax.facts import (
    ClassFacts,
    FieldFacts,
    FunctionFacts,
    Halstead,
    MethodFacts,
    SyntaxFault,
)
from roslens.source.syntax.query.cpp_query import Captures, Span
from roslens.source.syntax.token_cuts import TokenCuts
from roslens.source.syntax.tokens import NO_NAMES, TokenText

_LONGEST_NAME = 300
_NEAR = 60
_NOTHING = {""}
_REMEMBERED = 50_000
_LONGEST_REMEMBERED = 60
_Named = TypeVar("_Named")
_SCOPE = frozenset(b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_:")
_SCOPE_OR_SPACE = bytes(byte if byte in _SCOPE else 0x20 for byte in range(256))
_LETTERS = frozenset(b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_")


class _Remembered(dict[bytes, str]):
    """What stands in sources to the name that it is; those met first are remembered: files say the same names."""

    def __init__(self, name_of: Callable[[str], str]) -> None:
        super().__init__()
        self._name_of = name_of

    def __missing__(self, written: bytes) -> str:
        name = self._name_of(text_of(written))
        if len(written) < _LONGEST_REMEMBERED and len(self) < _REMEMBERED:
            self[written] = name
        return name


_NAMES = _Remembered(str)
_CALLEES = _Remembered(callee_name)


class _Places(Generic[_Named]):
    """Sorted positions with what is there; a span of source is a slice of both."""

    def __init__(self, starts: list[int], named: list[_Named]) -> None:
        """Keep positions and, in the same order, what is there."""
        self.starts = starts
        self.named = named

    def within(self, start: int, end: int) -> list[_Named]:
        """Return what begins from ``start`` to before ``end``."""
        return self.named[bisect_left(self.starts, start) : bisect_left(self.starts, end)]

    def number(self, start: int, end: int) -> int:
        """Return how much begins from ``start`` to before ``end``."""
        return bisect_left(self.starts, end) - bisect_left(self.starts, start)

    def outside(self, start: int, end: int, areas: Iterable[Span]) -> list[_Named]:
        """Return what begins from ``start`` to before ``end``, but in none of the sorted ``areas``."""
        found: list[_Named] = []
        for first, last in areas:
            if last > start:
                found += self.within(start, min(max(first, start), end))
                start = max(start, last)
        return found + self.within(start, max(start, end))


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
        self._end = len(text.code)
        self._tokens = TokenCuts(text, [place for scope in walk.functions for place in (*scope.span, *scope.body)])
        self._lines = lines
        self._statements = captures.statements
        self._fault_starts = [fault.line for fault in faults]
        self._fault_ends = [fault.end_line for fault in faults]
        self._walk = walk
        self._source = source
        called = sorted([*captures.callees, *walk.macro_calls]) if walk.macro_calls else captures.callees
        written = [source[start if end - start < _LONGEST_NAME else end - _LONGEST_NAME : end] for start, end in called]
        self._written = _Places([start for start, _ in called], written)
        self._called = _Places(self._written.starts, list(map(_CALLEES.__getitem__, written)))
        typed = _outside(captures.types, walk.macro_headers)
        # Most names of types have no scope before them.
        self._types = _Places(
            [start for start, _ in typed],
            [
                self._scoped_type(start, end)
                if source.startswith(b"::", start - 2, start)
                else _NAMES[source[start:end]]
                for start, end in typed
            ],
        )
        self._bodies = sorted(scope.body for scope in walk.functions)

    def function(self, scope: FunctionScope) -> FunctionFacts:
        """Return the facts of a function."""
        start, end = scope.span
        begin, finish = scope.body
        first, last = self._lines.number(start), self._lines.number(end - 1)
        declarator = scope.declarator
        counts = dict(scope.counts)
        inner = sorted(scope.inner)
        if called := self._called.outside(start, end, inner):
            counts["call"] = len(called)
            if recursions := self._written.outside(start, end, inner).count(declarator.name.encode()):
                counts["recursion"] = recursions
        if statements := self._within(scope.body) - sum(map(self._within, scope.inner)):
            counts["statement"] = statements
        body_first, body_last = self._lines.number(begin), self._lines.number(finish - 1)
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
            halstead=self._tokens.halstead(start, end),
            parameter_types=self._types_in(start, begin),
            types=self._types_in(start, end),
            calls=tuple(sorted({*called} - _NOTHING)),
            identifiers=self._identifiers(self._tokens.words(begin, finish)) if scope.class_name else (),
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
        scopes = self._walk.functions
        inside = sum(self._called.number(*scope.span) for scope in scopes)
        nested = sum(self._called.number(*span) for scope in scopes for span in scope.inner)
        if calls := len(self._called.starts) - inside + nested:
            counts["call"] = calls
        return counts

    def halstead(self) -> Halstead:
        """Return Halstead's counts of the whole file."""
        return self._tokens.halstead(0, self._end)

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

    def _with_calls(self, counts: Mapping[str, int], spans: Sequence[Span], inner: Sequence[Span]) -> dict[str, int]:
        """Return counts with the calls inside ``spans`` and outside ``inner``."""
        found = dict(counts)
        if calls := sum(len(self._called.outside(*span, inner)) for span in spans):
            found["call"] = calls
        return found

    def _types_in(self, start: int, end: int) -> tuple[str, ...]:
        return tuple(sorted(set(self._types.within(start, end))))

    def _types_outside_bodies(self, start: int, end: int) -> tuple[str, ...]:
        first = bisect_left(self._bodies, (start, 0))
        bodies = self._bodies[first : bisect_left(self._bodies, (end, 0))]
        return tuple(sorted(set(self._types.outside(start, end, bodies))))

    def _scoped_type(self, start: int, end: int) -> str:
        """Return the name of a type with the scope that is written before it."""
        source = self._source
        near = max(0, start - _NEAR)
        first = near + source[near:start].translate(_SCOPE_OR_SPACE).rfind(b" ") + 1
        while first == near > 0 and start - near < _LONGEST_NAME and source[first - 1] in _SCOPE:
            near = first = first - 1
        return _NAMES[source[first:end].lstrip(b":")]

    def _identifiers(self, words: Iterable[bytes]) -> tuple[str, ...]:
        return tuple(sorted([_NAMES[word] for word in set(words) - NO_NAMES if word[0] in _LETTERS]))

    def _is_approximate(self, first: int, last: int) -> bool:
        before = bisect_right(self._fault_starts, last)
        return before > 0 and self._fault_ends[before - 1] >= first
