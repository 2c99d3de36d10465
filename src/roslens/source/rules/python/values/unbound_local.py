"""Rule ``python.unbound_local``: a variable of a function that a branch gives no value, and that is read behind it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import is_handled
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_LEAVES = frozenset({"return_statement", "raise_statement", "continue_statement", "break_statement"})
_ENDS = re.compile(r"(?i)exit|abort|fail|shut_?down|quit|parser\.error|usage|kill|skip|refuse|raise|die\b")
"""In the name of a function that may not return."""
_INNER = ("function_definition", "lambda", "class_definition")
_STEPS = frozenset({"try_statement", "if_statement", "for_statement", "while_statement", "with_statement",
                    "match_statement"})  # fmt: skip
_RARE = re.compile(r"KeyboardInterrupt|SystemExit|ROSInterruptException|ExternalShutdown|NameError|UnboundLocalError")
_ANY = re.compile(r"^(?:Exception|BaseException)?$")
_SELDOM = "CvBridgeError"
"""What the tutorial of cv_bridge catches, and thousands of nodes with it; no image of a camera raises it."""
_RAISING = ("call", "subscript", "attribute", "await")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the read of each name that a handler, or one arm of a choice, leaves without a value."""
    function = above(node, *_INNER)
    if function is None or function.type != "function_definition":
        return
    missed = _missed_by_handlers(node, view) if node.type == "try_statement" else _missed_by_arms(node, view)
    certainty = Certainty.HEURISTIC if any(_SELDOM in _caught(one, view) for one in _handlers(node)) else None
    for name, where in missed.items():
        if _is_bound_elsewhere(name, node, function, view):
            continue
        read = _read_behind(name, node, view)
        if read is not None and not is_handled(read):
            yield view.hit(
                "python.unbound_local",
                read,
                f"`{name}` has no value where {where}: an UnboundLocalError here; expected a value before, or a way "
                "out there",
                certainty=certainty,
            )


def _missed_by_handlers(node: Node, view: FileView) -> dict[str, str]:
    """Return the names that the body of ``try`` binds and a handler that goes on does not, with where that is."""
    body = node.child_by_field_name("body")
    if body is None or any(one.type in ("finally_clause", "else_clause") for one in node.named_children):
        return {}
    missed: dict[str, str] = {}
    for handler in _handlers(node):
        block = next((one for one in handler.named_children if one.type == "block"), None)
        caught = _caught(handler, view)
        if block is None or _RARE.search(caught) or _leaves(block, view):
            continue
        line = handler.start_point[0] + 1
        for name in _bound_in(body, view, is_any=_ANY.match(caught) is not None):
            if not _binds(name, block, view):
                missed.setdefault(name, f"line {line} catches an exception and goes on")
    return missed


def _handlers(node: Node) -> list[Node]:
    return [one for one in node.named_children if one.type == "except_clause"]


def _caught(handler: Node, view: FileView) -> str:
    kinds = [one for one in handler.named_children if one.type not in ("block", "comment")]
    return re.sub(r"\s+as\s+\w+$", "", view.text(kinds[0])) if kinds else ""


def _bound_in(body: Node, view: FileView, *, is_any: bool) -> Iterator[str]:
    """Yield the names that statements of a block bind, which a raised exception may prevent."""
    statements = [one for one in body.named_children if one.type != "comment"]
    may_raise = False
    for number, one in enumerate(statements):
        may_raise = may_raise or _may_raise(one)
        # An exception of a certain kind may come from any call that follows.
        is_sure = is_any or not any(map(_may_raise, statements[number + 1 :]))
        if may_raise and is_sure:
            yield from _targets(one, view)


def _may_raise(statement: Node) -> bool:
    waiting = [statement]
    while waiting:
        one = waiting.pop()
        if one.type in _RAISING:
            return True
        waiting.extend(one.named_children)
    return False


def _missed_by_arms(node: Node, view: FileView) -> dict[str, str]:
    """Return the names that all arms of ``if`` bind but the last one, ``else``, with where that is."""
    last = next((one for one in node.named_children if one.type == "else_clause"), None)
    block = last.child_by_field_name("body") if last is not None else None
    if block is None or last is None or _leaves(block, view):
        return {}
    arms = [one.child_by_field_name("consequence") for one in (node, *node.named_children)]
    bound = [set(_all_targets(one, view)) for one in arms if one is not None and not _leaves(one, view)]
    common = set.intersection(*bound) if bound else set()
    line = last.start_point[0] + 1
    return {name: f"`else` of line {line} is taken" for name in sorted(common) if not _binds(name, block, view)}


def _all_targets(block: Node, view: FileView) -> Iterator[str]:
    for one in block.named_children:
        yield from _targets(one, view)


def _targets(statement: Node, view: FileView) -> Iterator[str]:
    """Yield the names that an assignment binds."""
    one = statement.named_children[0] if statement.type == "expression_statement" and statement.named_children else None
    while one is not None and one.type == "assignment":
        left = one.child_by_field_name("left")
        if left is not None:
            names = left.named_children if left.type in ("pattern_list", "tuple_pattern") else [left]
            yield from (view.text(name) for name in names if name.type == "identifier")
        one = one.child_by_field_name("right")


def _binds(name: str, block: Node, view: FileView) -> bool:
    """Return whether a block may bind a name: it stands in it other than as what is read."""
    text = view.code[block.start_byte : block.end_byte].decode("utf-8", "replace")
    bound = rf"(?<![\w.]){re.escape(name)}\b\s*(?:=(?!=)|,|:|\)|\]|\bin\b|$)|\b(?:def|class)\s+{re.escape(name)}\b"
    return re.search(bound, text, re.MULTILINE) is not None


def _leaves(block: Node, view: FileView) -> bool:
    """Return whether what stands behind a block may never be reached from it."""
    waiting = [block]
    while waiting:
        one = waiting.pop()
        if one.type in _LEAVES or (one.type == "assert_statement"):
            return True
        if one.type == "call" and _ENDS.search(view.text(one.child_by_field_name("function"))):
            return True
        if one.type in ("while_statement", "yield"):
            return True
        if one.type not in _INNER:
            waiting.extend(one.named_children)
    return False


def _is_bound_elsewhere(name: str, node: Node, function: Node, view: FileView) -> bool:
    """Return whether a function may have bound a name before a statement, in any way; names of others are not asked."""
    before = view.code[function.start_byte : node.start_byte].decode("utf-8", "replace")
    if re.search(rf"(?<![\w.]){re.escape(name)}\b", before):
        return True
    whole = view.code[function.start_byte : function.end_byte].decode("utf-8", "replace")
    return re.search(rf"\b(?:global|nonlocal|del)\b[^\n]*\b{re.escape(name)}\b", whole) is not None


def _read_behind(name: str, node: Node, view: FileView) -> Node | None:
    """Return where statements behind one, in its block, read a name whatever happens; None where one may bind it."""
    word = re.compile(rb"(?<![\w.])" + re.escape(name).encode() + rb"\b")
    statement = node.next_named_sibling
    while statement is not None:
        place = word.search(view.code, statement.start_byte, statement.end_byte)
        if place is not None:
            return _read_at(place.start(), place.end(), name, statement, view)
        if statement.type in _LEAVES:
            return None
        statement = statement.next_named_sibling
    return None


def _read_at(start: int, end: int, name: str, statement: Node, view: FileView) -> Node | None:
    """Return the name at a place in a statement where that is read first of all, and always."""
    found_ = view.node_at(start, end)
    if found_ is None or found_.type != "identifier" or name in set(_targets(statement, view)):
        return None
    inner, around = found_, found_.parent
    while around is not None and inner != statement:
        # The condition of `if` is always looked at, and so are the first operands of others.
        if around.type in _STEPS and inner != around.child_by_field_name("condition"):
            return None
        if around.type in (*_INNER, "conditional_expression", "boolean_operator") and inner != around.named_children[0]:
            return None
        if around.type in ("keyword_argument", "named_expression") and inner == around.child_by_field_name("name"):
            return None
        if around.type in ("for_in_clause", "delete_statement", "generator_expression", "list_comprehension"):
            return None
        inner, around = around, around.parent
    return found_


RULE = FileRule(
    id="python.unbound_local",
    title="Local variable that a branch leaves without a value",
    finds="A variable of a function that only the body of a `try` sets, while a handler goes on without a value, or "
    "all arms of an `if` but its `else`, and that is read behind it whatever happened. Set it before, or leave the "
    "function in the handler. Where a `CvBridgeError` is caught it is a note.",
    why="On the day that the transform is late or the command is unknown, an UnboundLocalError ends the callback, and "
    "with it the node.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("values",),
    clauses=("pylint E0606",),
    bad='def follow(self):\n    try:\n        pose = self.buffer.lookup_transform("map", "base", Time())\n'
    "    except Exception as error:\n        self.get_logger().warning(str(error))\n    self.drive_to(pose)\n",
    good='def follow(self):\n    try:\n        pose = self.buffer.lookup_transform("map", "base", Time())\n'
    "    except Exception as error:\n        self.get_logger().warning(str(error))\n        return\n"
    "    self.drive_to(pose)\n",
    syntax="python",
    kinds=("try_statement", "if_statement"),
    found=found,
)
