"""What stands around a name in code: the call it names, its arguments, the statement, the loop, the function."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from tree_sitter import Node

from roslens.source.rules.file_view import FileView, below

_LAST_NAME = {
    "field_expression": "field",
    "qualified_identifier": "name",
    "template_function": "name",
    "template_method": "name",
    "template_type": "name",
    "attribute": "attribute",
}
"""Types of nodes that name something, and the field that holds the last part of the name."""

AT_ONCE = re.compile(r"(?<![\d.])0+(\.0*)?(s|ms|us|ns)?(?![\d.])|zero\(\)")
"""A time limit of nothing: who waits so long does not wait."""
FUNCTIONS = ("function_definition", "lambda_expression", "lambda")
LOOPS = ("while_statement", "for_statement", "do_statement", "for_range_loop")
_TRANSPARENT = ("parenthesized_expression", "co_await_expression", "await")
_STATEMENTS = ("compound_statement", "block", "translation_unit", "module", "declaration_list")


def whole_name(node: Node) -> Node:
    """Return the name that ends in ``node``, with its object or scope and its template arguments."""
    parent = node.parent
    while parent is not None:
        field = _LAST_NAME.get(parent.type)
        last = parent.child_by_field_name(field) if field is not None else None
        if last != node and not (parent.type == "dependent_name" and parent.named_children[-1] == node):
            break
        node, parent = parent, parent.parent
    return node


def call_at(node: Node) -> Node | None:
    """Return the call whose callee ends in ``node``."""
    name = whole_name(node)
    call = name.parent
    if call is not None and call.type in ("call_expression", "call") and call.child_by_field_name("function") == name:
        return call
    return None


def arguments(call: Node) -> Sequence[Node]:
    """Return the arguments of a call or list of arguments, without keyword arguments and comments."""
    listed = call if call.type.endswith("_list") else call.child_by_field_name("arguments")
    if listed is None:
        return ()
    return [
        one for one in listed.named_children if one.type not in ("comment", "keyword_argument", "line_continuation")
    ]


def keywords(call: Node, view: FileView) -> Mapping[str, Node]:
    """Return the values of the keyword arguments of a call in Python by their name."""
    listed = call.child_by_field_name("arguments")
    found: dict[str, Node] = {}
    for one in listed.named_children if listed is not None else ():
        if one.type in ("keyword_argument", "dictionary_splat"):
            value = one.child_by_field_name("value")
            found[view.text(one.child_by_field_name("name")) or "**"] = value if value is not None else one
    return found


def receiver(call: Node) -> Node | None:
    """Return the object of which a method is called."""
    callee = call.child_by_field_name("function")
    while callee is not None and callee.type in ("template_function", "template_method"):
        callee = callee.child_by_field_name("name")
    if callee is None:
        return None
    return callee.child_by_field_name("argument") or callee.child_by_field_name("object")


def template_argument(call: Node, view: FileView) -> str:
    """Return the template arguments of a call as one text; empty without any."""
    callee = call.child_by_field_name("function")
    while callee is not None:
        listed = callee.child_by_field_name("arguments")
        if callee.type in ("template_function", "template_method") and listed is not None:
            return view.text(listed)[1:-1].strip()
        callee = callee.child_by_field_name("field") or callee.child_by_field_name("name")
    return ""


def constructed(name: Node) -> Sequence[Node] | None:
    """Return the arguments with which the type that ends in ``name`` is constructed, None where it is not.

    ``T(1)``, ``T t(1)``, ``T t{1}``, ``T{1}``.
    """
    name = whole_name(name)
    around = name.parent
    if around is None:
        return None
    if around.type == "call_expression" and around.child_by_field_name("function") == name:
        return arguments(around)
    if around.type == "compound_literal_expression":
        value = around.child_by_field_name("value")
        return arguments(value) if value is not None else None
    if around.type == "declaration" and around.child_by_field_name("type") == name:
        declarator = around.child_by_field_name("declarator")
        if declarator is not None and declarator.type == "init_declarator":
            value = declarator.child_by_field_name("value")
            if value is not None and value.type in ("argument_list", "initializer_list"):
                return arguments(value)
    return None


def function_around(node: Node) -> Node | None:
    """Return the innermost function or lambda around a node."""
    found = node.parent
    while found is not None and found.type not in FUNCTIONS:
        found = found.parent
    return found


def loop_around(node: Node) -> Node | None:
    """Return the innermost loop around a node that is in the same function."""
    found = node.parent
    while found is not None and found.type not in LOOPS:
        if found.type in FUNCTIONS:
            return None
        found = found.parent
    return found


def statement_around(node: Node) -> Node:
    """Return the statement that a node is part of: a child of the innermost block, or of the file."""
    found = node
    while found.parent is not None and found.parent.type not in _STATEMENTS:
        found = found.parent
    return found


def is_discarded(call: Node) -> bool:
    """Tell whether a call is a statement of its own, so that its result is lost."""
    around = call.parent
    while around is not None and around.type in _TRANSPARENT:
        around = around.parent
    return around is not None and around.type == "expression_statement"


_HANDLERS = ("catch_clause", "except_clause", "except_group_clause")


def is_handled(node: Node) -> bool:
    """Tell whether a ``try`` with a handler, of the same function, is around a node that stands in its body."""
    inner, found = node, node.parent
    while found is not None and found.type not in FUNCTIONS:
        # With ``finally`` alone everything goes on upwards.
        is_tried = found.type == "try_statement" and found.child_by_field_name("body") == inner
        if is_tried and any(one.type in _HANDLERS for one in found.children):
            return True
        inner, found = found, found.parent
    return False


def is_conditional(node: Node, until: Node) -> bool:
    """Tell whether something between a node and ``until`` decides whether the node runs: a branch, a handler."""
    found = node.parent
    while found is not None and found != until:
        if found.type in (
            *("if_statement", "elif_clause", "else_clause", "switch_statement", "case_statement", "catch_clause"),
            *("except_clause", "conditional_expression", "match_statement", "case_clause", "lambda_expression"),
        ):
            return True
        found = found.parent
    return False


def is_static(call: Node, view: FileView) -> bool:
    """Tell whether a static variable keeps what a call of C++ makes: it runs once, however often the function does."""
    around = call.parent
    declared = around.parent if around is not None and around.type == "init_declarator" else None
    specifiers = () if declared is None else declared.children
    return any(one.type == "storage_class_specifier" and view.text(one) == "static" for one in specifiers)


def body_of(function: Node) -> Node | None:
    """Return the body of a function, lambda or loop."""
    return function.child_by_field_name("body")


def called_names(node: Node, view: FileView) -> set[str]:
    """Return the last parts of the names of all calls below a node."""
    from roslens.source.rules.callbacks import callee_name

    return {callee_name(call, view) for call in below(node, "call_expression", "call")}


def number_of(node: Node | None, view: FileView) -> float | None:
    """Return the value of a literal number, with its sign, None for anything else."""
    text = view.text(node).replace("'", "")
    # In a hexadecimal number an F is a digit.
    text = text.rstrip("lLuU" if text.startswith(("0x", "0X", "-0x", "-0X")) else "fFlLuU")
    try:
        return float(int(text, 0))
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        return None


def whole_quotient(node: Node, view: FileView) -> tuple[int, bool] | None:
    """Return what a quotient of two whole literal numbers is in C++, and whether something is cut off."""
    if node.type != "binary_expression" or view.text(node.child_by_field_name("operator")) != "/":
        return None
    left, right = (view.text(node.child_by_field_name(side)) for side in ("left", "right"))
    if not left.isdecimal() or not right.isdecimal() or int(right) == 0:
        return None
    return int(left) // int(right), int(left) % int(right) != 0
