"""Rule ``cpp.text_after_endif``: text behind a directive."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.code_pattern import lines_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_TEXT = re.compile(rb"#[ \t]*(endif|else)[ \t]+([^\s/][^\n]*)")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such directive."""
    if b"#" not in view.code:
        return
    for match, line in lines_of(_TEXT, view, 2):
        text = match[2].decode("utf-8", "replace").strip()
        yield view.hit_at(
            "cpp.text_after_endif",
            line,
            f"`{shortened(text, 40)}` behind `#{match[1].decode()}`; expected `// {shortened(text, 40)}`",
            edits=_edits(match, view),
        )


def _edits(match: re.Match[bytes], view: FileView) -> tuple[Edit, ...]:
    start, end = match.end(1), match.start(2)
    rest = view.content[end : match.end()]
    if view.content[start:end].strip() or b"/*" in rest or rest.rstrip().endswith(b"\\"):
        return ()
    return view.edits((start, end, "  // "))


RULE = FileRule(
    id="cpp.text_after_endif",
    title="Text behind `#endif`",
    finds="Text behind `#endif` or `#else` that is no comment. Put `//` in front.",
    why="Compilers warn of it, and some refuse it.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint build/endif_comment",
        "paper2016 text_after_endif",
        "clang-tidy clang-diagnostic-extra-tokens",
    ),
    fix="Makes a comment of the text.",
    bad="#ifdef A\n#endif A\n",
    good="#ifdef A\n#endif  // A\n",
    syntax="cpp",
    whole=True,
    words=("endif", "else"),
    found=found,
)
