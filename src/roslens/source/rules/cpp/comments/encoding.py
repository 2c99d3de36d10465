"""Rule ``cpp.encoding``: bytes that are no text."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first line that cannot be read."""
    zero = view.content.find(b"\x00")
    if zero >= 0:
        yield view.hit_at("cpp.encoding", view.place(zero)[0], "a zero byte; expected text")
    if not view.content.isascii():
        try:
            view.content.decode("utf-8")
        except UnicodeDecodeError as error:
            yield view.hit_at(
                "cpp.encoding",
                view.place(error.start)[0],
                f"byte {view.content[error.start]:#x} is not UTF-8; expected UTF-8",
            )


RULE = FileRule(
    id="cpp.encoding",
    title="File that is not UTF-8",
    finds="A file that is not UTF-8, or holds a zero byte. Save it as UTF-8.",
    why="Tools and editors show something else, or stop.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/utf8",
        "cpplint readability/nul",
        "paper2016 non_ascii",
    ),
    bad="int a;\x00\n",
    good="int a;\n",
    syntax="cpp",
    whole=True,
    found=found,
)
