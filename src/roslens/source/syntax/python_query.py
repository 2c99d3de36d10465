"""Which nodes of a Python tree mean something to roslens, as one compiled query.

The name of a capture says what the node is for; its place in :data:`KINDS` is the number the walk dispatches on
and decides which of two nodes with the same extent comes first. One query and one look at each position is what
makes the walk cheap: reading attributes of nodes costs more than everything else.
"""

from __future__ import annotations

from collections.abc import Iterator

import tree_sitter_python
from tree_sitter import Language, Node, Parser, Query, QueryCursor, Tree

_KIND_WORDS = (
    "block decorator function class if elif else_arm for while try catch finally with switch case assert "
    "return throw break continue comprehension comprehension_for if_clause lambda ternary ternary_if ternary_else "
    "and or yield await callee type class_attribute self_attribute field_type field_constructor "
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
(conditional_expression "if" @ternary_if "else" @ternary_else) @ternary
(boolean_operator operator: "and") @and
(boolean_operator operator: "or") @or
(boolean_operator (boolean_operator) @operand)
(boolean_operator (parenthesized_expression (boolean_operator) @operand))
(boolean_operator (parenthesized_expression (parenthesized_expression (boolean_operator) @operand)))
[(expression_statement) (pass_statement) (delete_statement) (print_statement) (exec_statement)
 (import_statement) (import_from_statement) (future_import_statement)] @statement
(expression_statement . [(string) (concatenated_string)] .) @comment
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

_LANGUAGE = Language(tree_sitter_python.language())
_COMPILED = Query(_LANGUAGE, _QUERY)
_FAULTS = Query(_LANGUAGE, "(ERROR) @error (MISSING) @missing")
_KIND_NUMBERS = {name: number for number, name in enumerate(KINDS)}

Event = tuple[int, int, int]
"""Start, negated end and kind of a node: sorted, outer nodes come before inner ones."""


def parse_tree(source: bytes) -> Tree:
    """Parse ``source``; never fails, what is no Python becomes error nodes."""
    return Parser(_LANGUAGE).parse(source)


class Captures:
    """The nodes of a tree that mean something.

    Attributes:
        events: all of them in source order.
        statements: where simple statements begin that are no events; strings that stand alone are comments.
        interpolations: extents of the expressions in f-strings.
        operands: extents of the ``and`` and ``or`` that are operands of another one with nothing but (at most
            two pairs of) parentheses between.
        definitions: the nodes of functions and classes by their extent.
    """

    def __init__(self, tree: Tree) -> None:
        """Run the query over ``tree``."""
        captured = QueryCursor(_COMPILED).captures(tree.root_node)
        comments = {node.start_byte for node in captured.pop("comment", ())}
        starts = {node.start_byte for node in captured.pop("statement", ())}
        self.statements = sorted(starts - comments)
        self.interpolations = sorted(node.byte_range for node in captured.pop("interpolation", ()))
        self.operands = {node.byte_range for node in captured.pop("operand", ())}
        events: list[Event] = []
        for name, nodes in captured.items():
            kind = _KIND_NUMBERS[name]
            for node in nodes:
                start, end = node.byte_range
                events.append((start, -end, kind))
        events.sort()
        self.events = events
        self.definitions: dict[tuple[int, int], Node] = {
            node.byte_range: node for name in ("function", "class") for node in captured.get(name, ())
        }


def fault_nodes(tree: Tree) -> Iterator[Node]:
    """Yield the places that could not be parsed, in source order, the outermost only."""
    if not tree.root_node.has_error:
        return
    captured = QueryCursor(_FAULTS).captures(tree.root_node)
    end = -1
    for node in sorted((n for nodes in captured.values() for n in nodes), key=lambda n: (n.start_byte, -n.end_byte)):
        if node.start_byte >= end:
            yield node
            end = max(node.end_byte, end)
