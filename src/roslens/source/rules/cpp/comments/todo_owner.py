"""Rule ``cpp.todo_owner``: a note to do that nobody is named in."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_NOTE = re.compile(rb"//[ \t]*TODO(?!\([^)\n]+\):?[ \t])[^\n]*")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each note without a name."""
    if not view.mentions((b"TODO",)):
        return
    for match in _NOTE.finditer(view.content):
        text = match[0].decode("utf-8", "replace").strip()
        yield view.hit_at(
            "cpp.todo_owner",
            view.place(match.start())[0],
            f"`{shortened(text, 60)}` has no owner; expected a name in parentheses",
        )


RULE = FileRule(
    id="cpp.todo_owner",
    title="Note without a name",
    finds="A `TODO` without `(name)` behind it. Write `// TODO(name): what`.",
    why="It is unclear whom to ask.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/todo",
        "paper2016 todo_format",
        "clang-tidy google-readability-todo",
    ),
    bad="int a;  // TODO fix\n",
    good="int a;  // TODO(ann): fix\n",
    syntax="cpp",
    whole=True,
    found=found,
)
