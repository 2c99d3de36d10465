"""Rule ``python.encoding``: a file of Python with bytes that are not of its encoding."""

from __future__ import annotations

import codecs
import io
import tokenize
from collections.abc import Iterator

import msgspec
from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first line that is not of the encoding of the file, which PEP 263 says how to declare."""
    content = view.content
    if content.isascii() and b"coding" not in content[:300]:
        return
    try:
        name, read = tokenize.detect_encoding(io.BytesIO(content).readline)
    except SyntaxError as error:
        # The first two lines: an encoding that there is not, or bytes that are not of it.
        name, read = "utf-8", []
        if "invalid" not in str(error):
            yield view.hit_at("python.encoding", 1, f"{error}: Python refuses the file; expected utf-8")
            return
    try:
        codecs.lookup(name).decode(content)
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        declared = any(b"coding" in one for one in read)
        of = f"the declared encoding {name}" if declared else "UTF-8, and no other encoding is declared"
        node = view.node_at(error.start, error.start + 1)
        is_said = node is not None and node.type == "comment"
        refuses = "a Python that is given the file to run refuses it" if is_said else "Python refuses the file"
        message = f"byte 0x{content[error.start]:02x} is not of {of}: {refuses}; expected UTF-8"
        hit = view.hit_at("python.encoding", line, message)
        yield msgspec.structs.replace(hit, certainty=Certainty.LIKELY if is_said else None)


RULE = FileRule(
    id="python.encoding",
    title="Bytes that are not of the encoding (Python)",
    finds="A file with a byte that is not UTF-8 and no other encoding declared, one that is not of the declared "
    "encoding, or an encoding that Python does not have. Save the file as UTF-8.",
    why="Python ends with a SyntaxError before the first line runs: the node, launch file or setup.py does not start. "
    "A byte in a comment does no harm where the file is imported.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=(),
    clauses=("PEP 263",),
    syntax="python",
    whole=True,
    bad="# -*- coding: ascii -*-\nplace = 'Café'\n",
    good="place = 'Café'\n",
    found=found,
)
