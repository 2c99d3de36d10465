"""Facts of a Python file, from one parse by tree-sitter; Python 2 files too.

What the roles of :mod:`roslens.source.syntax.facts` mean in Python, and what is counted where, is decided in
:mod:`~roslens.source.syntax.python_walk`; what a name says in :mod:`~roslens.source.syntax.python_names`; which
lines are executed in :mod:`~roslens.source.syntax.python_lines`.

Parameters: the object or class that a method is called on (its first parameter, unless it is a ``staticmethod``)
is not counted, as ``this`` is not in C++; ``*args`` and ``**kwargs`` count as one each, ``/`` and ``*`` as none.
"""

from __future__ import annotations

from roslens.source.syntax.comments import blank_comments
from roslens.source.syntax.facts import FileFacts
from roslens.source.syntax.lines import count_lines
from roslens.source.syntax.python_assembly import Assembly
from roslens.source.syntax.python_lines import LineMap
from roslens.source.syntax.python_names import text_of
from roslens.source.syntax.python_tree import PythonTree, faults_of, parse_tree, with_line_feeds
from roslens.source.syntax.python_walk import Walk
from roslens.source.syntax.query.python_query import Captures
from roslens.source.syntax.tokens import hashes_of, token_text


def parse_python(content: bytes) -> FileFacts:
    """Parse a Python file and return its facts, as :func:`facts_of_python` does."""
    return facts_of_python(content, parse_tree(with_line_feeds(content)))


def facts_of_python(content: bytes, parsed: PythonTree, code: bytes | None = None) -> FileFacts:
    """Return the facts of a Python file.

    Never fails: what cannot be parsed becomes a :class:`~roslens.source.syntax.facts.SyntaxFault`, and the
    functions it stands in are marked approximate.

    Args:
        content: the bytes of the file.
        parsed: the tree of ``content`` with line feeds.
        code: the same with its comments blanked, where that is known.
    """
    text = with_line_feeds(content)
    captures = Captures(parsed.tree)
    walk = Walk(parsed.source, captures)
    code = blank_comments(text, "python") if code is None else code
    hashes, numbers = hashes_of(code)
    lines = LineMap(parsed.source, hashes, numbers, captures.idle)
    faults = faults_of(parsed, text, lines)
    assembly = Assembly(parsed.source, token_text(code, "python"), lines, captures, walk, faults)
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
