"""Which nodes of a C++ tree mean something to roslens, as one compiled query.

The name of a capture says what the node is for; its place in :data:`KINDS` is the number the walk dispatches on
and decides which of two nodes with the same extent comes first. One query and one look at each position is what
makes the walk cheap: reading attributes of nodes costs more than everything else. Only the bodies of functions and
classes are asked for one by one: a pattern with them takes long to compile, and that at every start.
"""

from __future__ import annotations

import re
import sys
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from itertools import accumulate
from operator import attrgetter

import tree_sitter_cpp
from tree_sitter import Language, Node, Parser, Query, QueryCursor, Tree

from roslens.source.syntax.endless_tree import refuse_endless
from roslens.source.syntax.query.asked_nodes import patterns_of, taken_from
from roslens.source.syntax.timed_parse import timed_parse

_STEP = 64
_KIND_WORDS = (
    "part_body part_condition namespace class function function_body field access friend try if else for while do "
    "switch catch case default lambda ternary and or preproc_if preproc_else return throw break continue goto label "
    "yield await"
)
KINDS = tuple(_KIND_WORDS.split())
"""Names of the captures that become events, outer before inner."""

_QUERY = """
(namespace_definition) @namespace
[(class_specifier) (struct_specifier) (union_specifier)] @class
(function_definition) @function
(field_declaration_list [(field_declaration) (declaration)] @field)
(field_declaration_list (template_declaration (declaration) @field))
(field_declaration_list (_ [(field_declaration) (declaration)] @field))
(friend_declaration) @friend
(access_specifier) @access
(if_statement consequence: (_) @part_body) @if
(else_clause) @else
(else_clause (if_statement) @else_if) @else_of_if
(for_statement body: (_) @part_body) @for
(for_range_loop body: (_) @part_body) @for
(while_statement body: (_) @part_body) @while
(do_statement condition: (_) @part_condition) @do
(switch_statement body: (_) @part_body) @switch
(case_statement value: (_)) @case
(case_statement "default") @default
(try_statement) @try
(catch_clause) @catch
(conditional_expression consequence: (_)? @part_body) @ternary
(binary_expression) @binary
(lambda_expression) @lambda
[(preproc_if) (preproc_ifdef)] @preproc_if
(preproc_if condition: (_) @compiled)
(preproc_elif condition: (_) @compiled)
(noexcept) @compiled
[(preproc_else) (preproc_elif) (preproc_elifdef)] @preproc_else
[(return_statement) (co_return_statement)] @return
(throw_statement) @throw
(break_statement) @break
(continue_statement) @continue
(goto_statement) @goto
(labeled_statement) @label
(co_yield_statement) @yield
(co_await_expression) @await
(expression_statement (_)) @statement
(init_declarator) @initialised
(declaration) @declaration
(for_statement initializer: (declaration) @in_header)
(condition_clause [(declaration) (init_statement (declaration))] @in_header)
(call_expression function: (_) @callee)
(type_identifier) @type
(preproc_include path: (_) @include)
"""

_LANGUAGE = Language(tree_sitter_cpp.language())
_PARSER = Parser(_LANGUAGE)
_KIND_NUMBERS = {name: number for number, name in enumerate(KINDS)}

Span = tuple[int, int]
Event = tuple[int, int, int]
"""Start, negated end and kind of a node: sorted, outer nodes come before inner ones."""


def parse_tree(source: bytes) -> Tree:
    """Parse ``source``; what is no C++ becomes error nodes.

    Raises:
        OverBudgetError: the time budget of the file is spent, or no query would end.
    """
    tree = timed_parse(_PARSER, source)
    refuse_endless(tree)
    return tree


def parse_again(source: bytes, earlier: bytes, tree: Tree) -> Tree:
    """Parse ``source``, of which ``earlier`` is a version of the same length with ``tree``, where it differs."""
    tree = tree.copy()
    starts = [0, *accumulate(map(_with_line_end, earlier.split(b"\n")))]

    def point(position: int) -> tuple[int, int]:
        row = bisect_right(starts, position) - 1
        return row, position - starts[row]

    for start, end in _differences(earlier, source):
        tree.edit(start, end, end, point(start), point(end), point(end))
    tree = timed_parse(_PARSER, source, tree)
    refuse_endless(tree)
    return tree


def _differences(one: bytes, other: bytes) -> list[Span]:
    """Return extents, in steps of some bytes, where two texts of the same length differ."""
    found: list[Span] = []
    for start in range(0, len(one), _STEP):
        end = min(start + _STEP, len(one))
        if one[start:end] != other[start:end]:
            begin = found.pop()[0] if found and found[-1][1] == start else start
            found.append((begin, end))
    return found


def _with_line_end(line: bytes) -> int:
    return len(line) + 1


class Captures:
    """The nodes of a tree that mean something.

    Attributes:
        events: those that the walk looks at, in source order.
        callees: extents of what is called, sorted; ``types`` those of names of types, ``includes`` of headers.
        statements: where simple statements begin, jumps and initialised declarations included.
        not_executed: extents of local declarations without an initialiser, and where labels stand.
        operators: extents of logical expressions to those of their operators.
        else_ifs: extents of the ``if`` of an ``else if``; ``else_of_ifs`` those of its ``else``.
        definitions: the nodes of functions, classes, namespaces and members by their kind, then by their extent.
        of_kinds: the nodes of each type or shape that was asked for besides.
    """

    def __init__(self, source: bytes, tree: Tree, kinds: frozenset[str] = frozenset()) -> None:
        """Run the query over the ``tree`` of a source, and in the same pass look for the nodes that others ask for."""
        captured = QueryCursor(_query(kinds)).captures(tree.root_node)
        self.of_kinds = taken_from(captured, kinds)

        if _BODY.search(source) and _EMPTY_BODY.search(source):
            captured["perhaps_function"] = _with_values(tree)
        captured["class"] = [node for node in captured.get("class", ()) if node.child_by_field_name("body") is not None]
        _tell_functions(captured)

        def spans(name: str) -> list[Span]:
            return list(map(_EXTENT, captured.pop(name, ())))

        self.operators: dict[Span, Span] = {}
        self.definitions: dict[str, dict[Span, Node]] = {}
        self.else_ifs = set(spans("else_if"))
        self.else_of_ifs = set(spans("else_of_if"))
        self.callees = sorted(spans("callee"))
        self.types = sorted(spans("type"))
        self.includes = sorted(spans("include"))
        starts = set(map(_START, captured.pop("statement", ())))
        labels = list(map(_EXTENT, captured.get("label", ())))
        initialised = sorted(map(_START, captured.pop("initialised", ())))
        self.not_executed: list[Span] = [(start, start + 1) for start, _ in labels]
        in_header = set(spans("in_header"))
        self._sort_declarations([one for one in spans("declaration") if one not in in_header], initialised, starts)
        decided_by_the_compiler = sorted(spans("compiled"))
        events: list[Event] = self._logical(captured.pop("binary", ()), decided_by_the_compiler)
        for name, nodes in captured.items():
            kind = _KIND_NUMBERS[name]
            extents = list(map(_EXTENT, nodes))
            events += [(start, -end, kind) for start, end in extents]
            if kind in _JUMPS:
                starts.update([start for start, _ in extents])
            elif name in _DEFINITIONS:
                self.definitions[name] = dict(zip(extents, nodes, strict=True))
        events.sort()
        self.events = events
        self.statements = sorted(starts)

    def _logical(self, nodes: Iterable[Node], left_out: Sequence[Span]) -> list[Event]:
        """Return the events of those binary expressions that are logical and stand outside the spans ``left_out``.

        A pattern that asks for the operator costs time quadratic in the length of ``a && b && c …``.
        """
        events = []
        for node in nodes:
            operator = node.child_by_field_name("operator")
            kind = _LOGICAL.get(operator.type) if operator is not None else None
            if operator is not None and kind is not None and not _within(node.start_byte, left_out):
                start, end = node.byte_range
                self.operators[start, end] = operator.byte_range
                events.append((start, -end, kind))
        return events

    def _sort_declarations(self, declarations: list[Span], initialised: list[int], starts: set[int]) -> None:
        for start, end in declarations:
            place = bisect_left(initialised, start)
            if place < len(initialised) and initialised[place] < end:
                starts.add(start)
            else:
                self.not_executed.append((start, end))


@cache
def _query(kinds: frozenset[str]) -> Query:
    """Return the query with the patterns of what others ask for."""
    query: Query = Query(_LANGUAGE, _QUERY + patterns_of(kinds))
    return query


_BODY = re.compile(rb"\{[^{};]{0,200}\}\s*;")
"""The end of :data:`_EMPTY_BODY`: found much sooner, as there are fewer braces than parentheses."""
_EMPTY_BODY = re.compile(rb"\)[\w\s>-]{0,60}\{[^{};]{0,200}\}\s*;")


@cache
def _value_query() -> Query:
    query: Query = Query(_LANGUAGE, "(field_declaration default_value: (initializer_list)) @found")
    return query


def _with_values(tree: Tree) -> list[Node]:
    """Return the members with a value in braces."""
    return QueryCursor(_value_query()).captures(tree.root_node).get("found", [])


_EXTENT: Callable[[Node], Span] = attrgetter("byte_range")
_START: Callable[[Node], int] = attrgetter("start_byte")
_LOGICAL = {
    word: _KIND_NUMBERS[kind] for kind, words in (("and", ("&&", "and")), ("or", ("||", "or"))) for word in words
}
_JUMPS = frozenset(_KIND_NUMBERS[name] for name in ("return", "throw", "break", "continue", "goto", "yield"))
_DEFINITIONS = frozenset({"function", "class", "namespace", "field", "friend"})


def _tell_functions(captured: dict[str, list[Node]]) -> None:
    """Leave those with a body among the functions; those that are defaulted, deleted or pure are fields."""
    functions: list[Node] = []
    bodies: list[Node] = []
    _take_bodies_for_values(captured, functions, bodies)
    for node in captured.get("function", ()):
        body = node.child_by_field_name("body")
        if body is None:
            inner = node.named_children
            kinds = [child.type for child in inner]
            if not _NO_BODIES.isdisjoint(kinds):
                captured.setdefault("field", []).append(node)
            if kinds[:2] != _TRIED:
                continue
            body = inner[1]
        functions.append(node)
        bodies.append(body)
    captured["function"], captured["function_body"] = functions, bodies


def _take_bodies_for_values(captured: dict[str, list[Node]], functions: list[Node], bodies: list[Node]) -> None:
    """Move members to the functions whose empty body parses as a value, as a semicolon is behind: ``void f() {};``."""
    for node in captured.pop("perhaps_function", ()):
        declarator, body = node.child_by_field_name("declarator"), node.child_by_field_name("default_value")
        while declarator is not None and declarator.type in ("pointer_declarator", "reference_declarator"):
            declarator = declarator.named_children[-1] if declarator.named_children else None
        if declarator is None or body is None or declarator.type != "function_declarator":
            continue
        name = declarator.child_by_field_name("declarator")
        empty = all(child.type == "comment" for child in body.named_children)
        if name is not None and name.type != "parenthesized_declarator" and empty:
            functions.append(node)
            bodies.append(body)
    extents = set(map(_EXTENT, functions))
    if extents:
        captured["field"] = [node for node in captured.get("field", ()) if node.byte_range not in extents]


_NO_BODIES = frozenset({"default_method_clause", "delete_method_clause", "pure_virtual_clause"})
_TRIED = ["function_declarator", "try_statement"]
"""What a constructor is made of whose body is ``try : member(1) { }``."""


def _within(position: int, spans: Sequence[Span]) -> bool:
    before = bisect_right(spans, (position, sys.maxsize))
    return before > 0 and position < spans[before - 1][1]


def fault_nodes(tree: Tree) -> list[Node]:
    """Return the places that could not be parsed, in source order, the outermost only."""
    found = []
    waiting = [tree.root_node]
    while waiting:
        node = waiting.pop()
        if node.is_error or node.is_missing:
            found.append(node)
        elif node.has_error:
            waiting += node.children
    found.sort(key=lambda node: (node.start_byte, -node.end_byte))
    ends = accumulate((node.end_byte for node in found), max, initial=-1)
    return [node for node, end in zip(found, ends, strict=False) if node.start_byte >= end]
