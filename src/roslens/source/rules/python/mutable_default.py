"""Rule ``python.mutable_default``: a default that all calls share, and that one of them changes."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_MUTABLE = frozenset({"list", "dictionary", "set", "list_comprehension", "dictionary_comprehension"})
_MAKES = frozenset({"list", "dict", "set", "defaultdict", "deque", "OrderedDict"})
_CHANGES = "append|extend|insert|update|add|pop|remove|clear|setdefault|sort|discard|popleft|appendleft"


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the default of a parameter that the function changes, keeps or returns."""
    name, value = node.child_by_field_name("name"), node.child_by_field_name("value")
    function = above(node, "function_definition", "lambda")
    if name is None or value is None or function is None or not _is_mutable(value, view):
        return
    body = function.child_by_field_name("body")
    text = view.source[body.start_byte : body.end_byte].decode("utf-8", "replace") if body is not None else ""
    word = re.escape(view.text(name))
    if re.search(rf"^\s*{word}\s*=[^=]", text, re.MULTILINE):
        return
    changed = rf"\b{word}\.(?:{_CHANGES})\(|\b{word}\[[^\]]*\]\s*[+-]?=[^=]|\b{word}\s*\+="
    kept = re.search(rf"([\w.]+\.\w+)\s*=\s*{word}\s*$", text, re.MULTILINE)
    is_shared = kept is not None and _is_changed(kept[1], view)
    if is_shared or re.search(rf"(?<![\w.]){changed}|return {word}\s*$", text, re.MULTILINE):
        message = (
            f"all calls share the default {view.text(value)!r} of {view.text(name)!r}; expected None, replaced inside"
        )
        yield view.hit("python.mutable_default", node, message)


def _is_changed(attribute: str, view: FileView) -> bool:
    """Return whether an attribute that keeps a default may be changed: of the object itself only what the file does."""
    owner, _, name = attribute.rpartition(".")
    if owner != "self":
        return True
    changed = rf"\.{name}\.(?:{_CHANGES})\(|\.{name}\[[^\]]*\]\s*[+-]?=[^=]|\.{name}\s*\+="
    return re.search(changed.encode(), view.source) is not None


def _is_mutable(value: Node, view: FileView) -> bool:
    if value.type == "call":
        return view.text(value.child_by_field_name("function")) in _MAKES
    return value.type in _MUTABLE


RULE = FileRule(
    id="python.mutable_default",
    title="Default that calls share and change",
    finds="A list, dictionary or set as the default of a parameter, where the function changes it, keeps it in an "
    "attribute that is changed later, or returns it. Use `None`, and make a new one inside.",
    why="The default is made once: what one node, or one callback, adds to it is there for all others.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("default_parameter", "typed_default_parameter"),
    clauses=("pylint W0102", "ruff B006"),
    bad="def plan(goal, visited=[]):\n    visited.append(goal)\n    return visited",
    good="def plan(goal, visited=None):\n    visited = visited or []\n    visited.append(goal)\n    return visited",
    found=found,
)
