"""Facts of a Python file, from one parse by tree-sitter; Python 2 files too.

What the roles of :mod:`roslens.source.syntax.facts` mean in Python, and what is counted where, is decided in
:mod:`~roslens.source.syntax.python_walk`; what a name says in :mod:`~roslens.source.syntax.python_names`; which
lines are executed in :mod:`~roslens.source.syntax.python_lines`.

Parameters: the object or class that a method is called on (its first parameter, unless it is a ``staticmethod``)
is not counted, as ``this`` is not in C++; ``*args`` and ``**kwargs`` count as one each, ``/`` and ``*`` as none.
"""

from __future__ import annotations

import re

from tree_sitter import Tree

from roslens.source.syntax.comments import blank_comments
from roslens.source.syntax.facts import FileFacts, SyntaxFault
from roslens.source.syntax.lines import count_lines
from roslens.source.syntax.python_assembly import Assembly
from roslens.source.syntax.python_lines import LineMap
from roslens.source.syntax.python_names import text_of
from roslens.source.syntax.python_query import Captures, fault_nodes, parse_tree
from roslens.source.syntax.python_walk import Walk
from roslens.source.syntax.tokens import hashes_of, token_text

_LONE_CARRIAGE_RETURN = re.compile(rb"\r(?!\n)")
_NO_UTF_8 = bytes(range(128)) + b"_" * 128
_LONGEST_QUOTE = 60


def parse_python(content: bytes) -> FileFacts:
    """Return the facts of a Python file.

    Never fails: what cannot be parsed becomes a :class:`~roslens.source.syntax.facts.SyntaxFault`, and the
    functions it stands in are marked approximate.
    """
    source = _parseable(content)
    tree = parse_tree(source)
    captures = Captures(tree)
    walk = Walk(source, captures)
    code = blank_comments(content, "python")
    hashes, numbers = hashes_of(code)
    lines = LineMap(source, hashes, numbers)
    faults = _faults(source, tree, lines)
    assembly = Assembly(source, token_text(code, "python"), lines, captures, walk, faults)
    return FileFacts(
        syntax="python",
        lines=count_lines(content, "python"),
        halstead=assembly.halstead(0, len(code)),
        functions=tuple(map(assembly.function, walk.functions)),
        classes=tuple(map(assembly.of_class, walk.classes)),
        top_level=assembly.counts(walk.file),
        includes=tuple((text_of(name), lines.number(start)) for name, start in walk.imports),
        line_hashes=hashes,
        line_numbers=numbers,
        faults=faults,
    )


def _parseable(content: bytes) -> bytes:
    """Return ``content`` with every byte in its place, but as UTF-8 and with line ends that the parser knows.

    In another encoding only strings and comments hold more than ASCII as a rule; what their letters are does not
    matter here.
    """
    try:
        content.decode()
    except UnicodeDecodeError:
        content = content.translate(_NO_UTF_8)
    return _LONE_CARRIAGE_RETURN.sub(b"\n", content) if b"\r" in content else content


def _faults(source: bytes, tree: Tree, lines: LineMap) -> tuple[SyntaxFault, ...]:
    faults = []
    for node in fault_nodes(tree):
        start, end = node.byte_range
        if node.is_missing:
            text = f"{node.type} is missing"
        else:
            text = " ".join(text_of(source[start : min(end, start + _LONGEST_QUOTE)]).split())
        line = lines.number(start)
        faults.append(
            SyntaxFault(line, start - lines.start(line) + 1, max(lines.number(max(end - 1, start)), line), text)
        )
    return tuple(faults)
