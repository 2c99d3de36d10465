"""The tree of a Python file, whatever its bytes are, and what of it could not be parsed.

tree-sitter takes any text, but three things need help: bytes that are no UTF-8; carriage returns that end a line,
which Python allows; and texts so far from Python that time would grow with the square of their size.
Every byte keeps its place.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

import tree_sitter_python
from tree_sitter import Language, Node, Parser, Query, QueryCursor, Tree

from roslens.source.syntax.facts import SyntaxFault
from roslens.source.syntax.python_lines import LineMap
from roslens.source.syntax.python_names import text_of
from roslens.source.syntax.timed_parse import timed_parse

LANGUAGE = Language(tree_sitter_python.language())

_LONE_CARRIAGE_RETURN = re.compile(rb"\r(?!\n)")
_NO_UTF_8 = bytes(range(128)) + b"_" * 128
_CONTINUATIONS = re.compile(rb"(?:\\\n){100,}")
_BLANK = bytes(byte if byte in b"\r\n" else 0x20 for byte in range(256))
DEEPEST = 60_000
"""A query counts levels in 16 bits and never ends when they run over: it must not look deeper."""
_LONGEST_RUN = 500
_MOST_ROUNDS = 4
_LONGEST_QUOTE = 60
_SPACE = re.compile(r"[ \t\r\n\f]+")
_FAULTS = Query(LANGUAGE, "(ERROR) @error (MISSING) @missing")


@dataclass(frozen=True, slots=True)
class PythonTree:
    """A parsed file.

    ``source`` is what was parsed: the content with nothing but bytes replaced. ``blanked`` are spans in which
    there was nothing to be understood.
    """

    source: bytes
    tree: Tree
    blanked: tuple[tuple[int, int], ...] = ()


def with_line_feeds(content: bytes) -> bytes:
    """Return ``content`` with line feeds where a carriage return alone ends a line, as Python allows."""
    return _LONE_CARRIAGE_RETURN.sub(b"\n", content) if b"\r" in content else content


def parse_tree(content: bytes) -> PythonTree:
    """Parse a file; what is no Python becomes error nodes or is blanked.

    Raises:
        OverBudgetError: the time budget of the file is spent.
    """
    source = _parseable(content)
    parser = Parser(LANGUAGE)
    tree = timed_parse(parser, source)
    blanked: list[tuple[int, int]] = []
    for _ in range(_MOST_ROUNDS):
        runs = list(_hopeless_runs(tree)) if tree.root_node.has_error else []
        if not runs:
            break
        blanked += runs
        source = _without(source, runs)
        tree = timed_parse(parser, source)
    return PythonTree(source, tree, tuple(blanked))


def faults_of(parsed: PythonTree, content: bytes, lines: LineMap) -> tuple[SyntaxFault, ...]:
    """Return the places that could not be parsed, in source order, the outermost only."""
    root = parsed.tree.root_node
    if not (root.has_error or parsed.blanked):
        return ()
    spans = [(start, end, "") for start, end in parsed.blanked]
    cursor = QueryCursor(_FAULTS)
    cursor.set_max_start_depth(DEEPEST)
    for nodes in cursor.captures(root).values():
        spans += [(*node.byte_range, f"{node.type} is missing" if node.is_missing else "") for node in nodes]
    faults = []
    reached = -1
    for start, end, missing in sorted(spans, key=lambda span: (span[0], -span[1])):
        if start < reached:
            continue
        reached = max(end, reached)
        line = lines.number(start)
        text = missing or _quote(content[start:end]) or "unexpected white space"
        last_line = max(lines.number(max(end - 1, start)), line)
        faults.append(SyntaxFault(line, start - lines.start(line) + 1, last_line, text))
    return tuple(faults)


def _quote(found: bytes) -> str:
    text = _SPACE.sub(" ", text_of(found[: 4 * _LONGEST_QUOTE])).strip(" ")
    text = "".join(letter if letter.isprintable() else f"\\x{ord(letter):02x}" for letter in text)
    return text if len(text) <= _LONGEST_QUOTE else text[: _LONGEST_QUOTE - 1] + "…"


def _parseable(content: bytes) -> bytes:
    """Return ``content`` as UTF-8 and without what the parser is slow on.

    In another encoding only strings and comments hold more than ASCII as a rule; what their letters are does not
    matter here.
    """
    try:
        content.decode()
    except UnicodeDecodeError:
        content = content.translate(_NO_UTF_8)
    if b"\\\n\\\n" in content:
        content = _CONTINUATIONS.sub(lambda match: match[0].translate(_BLANK), content)
    return content


def _hopeless_runs(tree: Tree) -> Iterator[tuple[int, int]]:
    """Yield the spans of error nodes in which hundreds of signs and keywords follow each other.

    The time that a query takes grows with the square of their number.
    """
    nodes = [tree.root_node]
    while nodes:
        node = nodes.pop()
        children = node.children
        if node.is_error and len(children) > _LONGEST_RUN:
            yield from _runs_of_signs(children)
        nodes.extend(child for child in children if child.has_error)


def _runs_of_signs(children: list[Node]) -> Iterator[tuple[int, int]]:
    for named, group in groupby(children, key=lambda child: child.is_named):
        run = [] if named else list(group)
        if len(run) > _LONGEST_RUN:
            yield run[0].start_byte, run[-1].end_byte


def _without(source: bytes, spans: list[tuple[int, int]]) -> bytes:
    pieces = []
    done = 0
    for start, end in sorted(spans):
        pieces += [source[done:start], source[start:end].translate(_BLANK)]
        done = end
    return b"".join([*pieces, source[done:]])
