"""Rule ``cpp.namespace_end``: a brace that does not say what it closes."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.spans import line_around


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each long namespace without a comment at its end."""
    first, last = view.place(node.start_byte)[0], view.place(max(node.end_byte - 1, 0))[0]
    if last - first < 10 or last > len(view.lines):
        return
    tail = view.lines[last - 1]
    name = view.text(node.child_by_field_name("name"))
    if (b"//" not in tail and b"/*" not in tail) or (name and name.rpartition("::")[2].encode() not in tail):
        yield view.hit_at(
            "cpp.namespace_end",
            last,
            f"end of namespace {name or 'without a name'}; expected `// namespace {name}`".rstrip(),
            edits=_edits(node, name, view),
        )


def _edits(node: Node, name: str, view: FileView) -> tuple[Edit, ...]:
    end = node.end_byte
    _, behind = line_around(view.content, end - 1)
    if node.has_error or view.content[end - 1 : end] != b"}" or view.content[end:behind].strip():
        return ()
    return view.edits((end, end, f"  // namespace {name}".rstrip()))


RULE = FileRule(
    id="cpp.namespace_end",
    title="Namespace whose end is not named",
    finds="A namespace of more than ten lines whose closing brace has no comment `// namespace name`.",
    why="At the end of a long file one cannot see what is closed.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/namespace",
        "paper2016 namespace_end_comment",
        "clang-tidy google-readability-namespace-comments",
    ),
    fix="Adds the comment. Where the line has another comment, it is left.",
    bad="namespace a {\n\n\n\n\n\n\n\n\n\n\n\n}\n",
    good="namespace a {\n\n\n\n\n\n\n\n\n\n\n\n}  // namespace a\n",
    syntax="cpp",
    kinds=("namespace_definition",),
    found=found,
)
