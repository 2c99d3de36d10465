"""Statements of C++ as rules read them."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.rules.file_view import FileView, above

JUMPS = ("return_statement", "throw_statement", "goto_statement", "break_statement", "continue_statement")
"""Types of statements behind which nothing runs."""
_NEVER_RETURN = frozenset({"exit", "abort", "std::exit", "std::abort", "_exit", "quick_exit", "std::terminate"})
_NO_STATEMENTS = ("comment", "preproc_call", "preproc_def")


def is_inside_function(node: Node) -> bool:
    """Return whether a node stands in the body of a function."""
    return above(node, "compound_statement", "lambda_expression") is not None


def last_statement(block: Node) -> Node | None:
    """Return the last statement of a block or ``case``; of a nested block the last one in it."""
    found: Node | None = None
    while True:
        inside = [one for one in block.named_children if one.type not in _NO_STATEMENTS]
        if not inside:
            return found
        found = inside[-1]
        if found.type != "compound_statement":
            return found
        block = found


def ends_flow(statement: Node | None, view: FileView) -> bool:
    """Return whether what follows a statement is never reached from it."""
    if statement is None:
        return False
    if statement.type in JUMPS:
        return True
    if statement.type == "compound_statement":
        return ends_flow(last_statement(statement), view)
    if statement.type == "expression_statement" and statement.named_child_count:
        inner = statement.named_children[0]
        return inner.type == "call_expression" and callee(inner, view) in _NEVER_RETURN
    if statement.type == "if_statement":
        other = statement.child_by_field_name("alternative")
        if other is None or not other.named_child_count:
            return False
        then = statement.child_by_field_name("consequence")
        return ends_flow(then, view) and ends_flow(other.named_children[-1], view)
    return False


def callee(call: Node, view: FileView) -> str:
    """Return what a call calls, as it is written."""
    return view.text(call.child_by_field_name("function"))


def plain(node: Node | None) -> Node | None:
    """Return an expression without the parentheses around it."""
    while node is not None and node.type == "parenthesized_expression" and node.named_child_count == 1:
        node = node.named_children[0]
    return node


def free_call(name: Node, view: FileView) -> Node | None:
    """Return the call of which a name is the function, written alone, as ``std::name`` or as ``::name``."""
    if name.type != "identifier" or name.parent is None:
        return None
    function, around = name, name.parent
    if around.type == "qualified_identifier" and around.parent is not None:
        if view.text(around.child_by_field_name("scope")) not in ("std", ""):
            return None
        function, around = around, around.parent
    if around.type != "call_expression" or around.child_by_field_name("function") != function:
        return None
    return around


def arguments_of(call: Node) -> list[Node]:
    """Return the arguments of a call."""
    listed = call.child_by_field_name("arguments")
    return [one for one in listed.named_children if one.type != "comment"] if listed is not None else []


def next_statement(node: Node) -> Node | None:
    """Return what follows a statement in its block, comments left out."""
    found = node.next_named_sibling
    while found is not None and found.type == "comment":
        found = found.next_named_sibling
    return found


def is_written_twice(left: Node, node: Node, view: FileView) -> bool:
    """Return whether the right side of an expression, its last part, is written like its ``left`` one.

    Most differ at their end already, and a node costs more than a look at the text.
    """
    text = view.content[left.start_byte : left.end_byte]
    end = node.end_byte
    if not text or not view.content.endswith(text, left.end_byte, end):
        return False
    right = node.child_by_field_name("right")
    return right is not None and right.end_byte - right.start_byte == len(text) and same_text(left, right, view)


def same_text(one: Node, other: Node, view: FileView) -> bool:
    """Return whether two nodes are written alike in the file, where macros still stand."""
    return view.content[one.start_byte : one.end_byte] == view.content[other.start_byte : other.end_byte]
