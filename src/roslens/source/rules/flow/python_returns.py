"""What a function of Python returns: on which ways nothing, and whether anywhere something."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec
from tree_sitter import Node

from roslens.source.rules.file_view import FileView

_INNER = ("function_definition", "lambda", "class_definition")
_EXITS = frozenset({"sys.exit", "exit", "quit", "os._exit"})


class Returns(msgspec.Struct, frozen=True, eq=False):
    """What a function returns.

    Attributes:
        values: the statements that return something.
        empty: the statements that return nothing, or ``None``.
        falls_off: its end is reached.
        is_generator: it yields, and returns an iterator.
    """

    values: tuple[Node, ...]
    empty: tuple[Node, ...]
    falls_off: bool
    is_generator: bool


def returns_of(function: Node, view: FileView) -> Returns:
    """Return what a function with a body of statements returns."""
    body = function.child_by_field_name("body")
    values: list[Node] = []
    empty: list[Node] = []
    is_generator = False
    for one in _own(body) if body is not None else ():
        if one.type == "yield":
            is_generator = True
        elif one.type == "return_statement":
            value = next(iter(one.named_children), None)
            nothing = value is None or value.type in ("none", "comment")
            (empty if nothing else values).append(one)
    return Returns(tuple(values), tuple(empty), body is not None and _falls_off(body, view), is_generator)


def _own(node: Node) -> Iterator[Node]:
    """Yield the nodes of a function, not those of functions in it."""
    waiting = list(reversed(node.children))
    while waiting:
        one = waiting.pop()
        yield one
        if one.type not in _INNER:
            waiting.extend(reversed(one.children))


def _falls_off(block: Node | None, view: FileView) -> bool:
    """Tell whether what stands behind a block is reached."""
    return block is not None and not any(_ends(one, view) for one in block.named_children)


def _ends(statement: Node, view: FileView) -> bool:
    """Tell whether nothing behind a statement is reached."""
    match statement.type:
        case "return_statement" | "raise_statement" | "continue_statement" | "break_statement":
            return True
        case "expression_statement":
            call = next(iter(statement.named_children), None)
            return call is not None and call.type == "call" and _callee(call, view) in _EXITS
        case "if_statement":
            return _all_end(_branches(statement), view) and _has(statement, "else_clause")
        case "try_statement":
            return _try_ends(statement, view)
        case "with_statement":
            return not _falls_off(statement.child_by_field_name("body"), view)
        case "while_statement":
            condition = statement.child_by_field_name("condition")
            endless = condition is not None and (condition.type == "true" or view.text(condition) == "1")
            return endless and not _breaks(statement)
        case "match_statement":
            return _match_ends(statement, view)
    return False


def _branches(statement: Node) -> Sequence[Node | None]:
    found = [statement.child_by_field_name("consequence")]
    for one in statement.named_children:
        if one.type == "elif_clause":
            found.append(one.child_by_field_name("consequence"))
        elif one.type == "else_clause":
            found.append(one.child_by_field_name("body"))
    return found


def _all_end(blocks: Sequence[Node | None], view: FileView) -> bool:
    return all(not _falls_off(one, view) for one in blocks)


def _try_ends(statement: Node, view: FileView) -> bool:
    finally_clause = next((one for one in statement.named_children if one.type == "finally_clause"), None)
    if finally_clause is not None and not _falls_off(_block(finally_clause), view):
        return True
    body = statement.child_by_field_name("body")
    otherwise = next((one for one in statement.named_children if one.type == "else_clause"), None)
    handlers = [_block(one) for one in statement.named_children if one.type.startswith("except")]
    main = not _falls_off(body, view) or (otherwise is not None and not _falls_off(_block(otherwise), view))
    return main and _all_end(handlers, view)


def _match_ends(statement: Node, view: FileView) -> bool:
    body = statement.child_by_field_name("body")
    cases = [one for one in (body or statement).named_children if one.type == "case_clause"]
    is_whole = any(view.text(one).replace(" ", "").startswith("case_:") for one in cases)
    return is_whole and _all_end([one.child_by_field_name("consequence") for one in cases], view)


def _block(clause: Node) -> Node | None:
    return next((one for one in reversed(clause.named_children) if one.type == "block"), None)


def _has(statement: Node, kind: str) -> bool:
    return any(one.type == kind for one in statement.named_children)


def _breaks(loop: Node) -> bool:
    """Tell whether a ``break`` leaves a loop itself."""
    waiting = list(loop.children)
    while waiting:
        one = waiting.pop()
        if one.type == "break_statement":
            return True
        if one.type not in (*_INNER, "while_statement", "for_statement"):
            waiting.extend(one.children)
    return False


def _callee(call: Node, view: FileView) -> str:
    return view.text(call.child_by_field_name("function"))
