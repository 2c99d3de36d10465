"""Which nodes of a Python tree mean something to roslens, as one compiled query.

The name of a capture says what the node is for; its place in :data:`KINDS` is the number the walk dispatches on
and decides which of two nodes with the same extent comes first. One query and one look at each position is what
makes the walk cheap: reading attributes of nodes costs more than everything else.

No pattern asks for a node and its descendants where such nodes can stand in each other without end (``and`` in
``and``): a half-made match waits at every level, and the time would grow with the square of the depth.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from operator import attrgetter

from tree_sitter import Node, Query, QueryCursor, Tree

from roslens.source.syntax.python_tree import DEEPEST, LANGUAGE

_KIND_WORDS = (
    "block decorator function class if elif else_arm for while try catch finally with switch case assert "
    "return throw break continue comprehension comprehension_for if_clause lambda ternary ternary_if ternary_else "
    "parentheses and or yield await callee type class_attribute self_attribute field_type field_constructor "
    "import bound future_import"
)
KINDS = tuple(_KIND_WORDS.split())
"""Names of the captures that become events, outer before inner."""

_FIELD = "type: (type)? @field_type right: (call function: [(identifier) (attribute)] @field_constructor)?"

_QUERY = f"""
(block) @block
(decorator) @decorator
(function_definition) @function
(class_definition) @class
(if_statement) @if
(elif_clause) @elif
(else_clause) @else_arm
(for_statement) @for
(while_statement) @while
(try_statement) @try
(except_clause) @catch
(finally_clause) @finally
(with_statement) @with
(match_statement) @switch
(case_clause) @case
(assert_statement) @assert
(return_statement) @return
(raise_statement) @throw
(break_statement) @break
(continue_statement) @continue
[(list_comprehension) (set_comprehension) (dictionary_comprehension) (generator_expression)] @comprehension
(for_in_clause) @comprehension_for
(if_clause) @if_clause
(lambda) @lambda
(conditional_expression) @ternary
(boolean_operator) @logical
(parenthesized_expression) @parentheses
[(expression_statement) (pass_statement) (delete_statement) (print_statement) (exec_statement)
 (import_statement) (import_from_statement) (future_import_statement)] @statement
(expression_statement . [(string) (concatenated_string)] .) @comment
[(global_statement) (nonlocal_statement)] @declaration
(interpolation) @interpolation
(yield) @yield
(await) @await
(call function: (_) @callee)
(type) @type
(class_definition body: (block (expression_statement (assignment left: (identifier) @class_attribute {_FIELD}))))
(class_definition body: (block (expression_statement
  (assignment left: [(pattern_list (identifier) @class_attribute) (tuple_pattern (identifier) @class_attribute)]))))
(assignment left: (attribute) @self_attribute {_FIELD})
(assignment left: [(pattern_list (attribute) @self_attribute) (tuple_pattern (attribute) @self_attribute)])
(import_statement name: [(dotted_name) @import (aliased_import name: (dotted_name) @import alias: (_) @bound)])
(import_from_statement module_name: (_) @import)
(import_from_statement name: [(dotted_name) @bound (aliased_import alias: (_) @bound)])
(future_import_statement) @future_import
"""

_COMPILED = Query(LANGUAGE, _QUERY)
_KIND_NUMBERS = {name: number for number, name in enumerate(KINDS)}

Span = tuple[int, int]
Event = tuple[int, int, int]
"""Start, negated end and kind of a node: sorted, outer nodes come before inner ones."""
_EXTENT: Callable[[Node], Span] = attrgetter("byte_range")


class Captures:
    """The nodes of a tree that mean something.

    Attributes:
        events: all of them in source order.
        statements: where simple statements begin that are no events.
        idle: extents of what looks like a statement and does nothing: strings that stand alone, ``global`` and
            ``nonlocal``.
        interpolations: extents of the expressions in f-strings.
        definitions: the nodes of functions and classes by their extent.
        operators: extents of the words ``and`` and ``or`` by that of their expression.
    """

    def __init__(self, tree: Tree) -> None:
        """Run the query over ``tree``."""
        cursor = QueryCursor(_COMPILED)
        cursor.set_max_start_depth(DEEPEST)
        captured = cursor.captures(tree.root_node)
        comments = list(map(_EXTENT, captured.pop("comment", ())))
        starts = set(map(attrgetter("start_byte"), captured.pop("statement", ())))
        self.statements = sorted(starts.difference(start for start, _ in comments))
        self.idle = [*comments, *map(_EXTENT, captured.pop("declaration", ()))]
        self.interpolations = sorted(map(_EXTENT, captured.pop("interpolation", ())))
        self.definitions = {node.byte_range: node for name in ("function", "class") for node in captured.get(name, ())}
        self.operators: dict[Span, Span] = {}
        events = list(self._logical_events(captured.pop("logical", ())))
        for node in captured.get("ternary", ()):
            events.extend(_ternary_words(node))
        for name, nodes in captured.items():
            kind = _KIND_NUMBERS[name]
            events += [(start, -end, kind) for start, end in map(_EXTENT, nodes)]
        events.sort()
        self.events = events

    def _logical_events(self, nodes: Iterable[Node]) -> Iterator[Event]:
        for node in nodes:
            operator = node.child_by_field_name("operator")
            if operator is not None:
                start, end = node.byte_range
                self.operators[start, end] = operator.byte_range
                yield start, -end, _KIND_NUMBERS[operator.type]


def _ternary_words(node: Node) -> Iterator[Event]:
    """Yield the words that part a conditional expression into its three."""
    for child in node.children:
        if child.type in {"if", "else"}:
            yield child.start_byte, -child.end_byte, _KIND_NUMBERS[f"ternary_{child.type}"]
