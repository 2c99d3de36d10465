"""Facts of a C or C++ file, from one parse by tree-sitter.

Decisions are counted as written: macros are not expanded, lambdas count for the function around them, and every arm of
``#if`` counts. A TEST macro with a body is a function whose name holds its arguments: ``TEST_F(Suite,Name)``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from tree_sitter import Tree

from roslens.source.syntax.comments import blank_cpp
from roslens.source.syntax.cpp_assembly import Assembly
from roslens.source.syntax.cpp_lines import LineMap
from roslens.source.syntax.cpp_names import text_of
from roslens.source.syntax.cpp_repair import repaired
from roslens.source.syntax.cpp_walk import Walk
from roslens.source.syntax.facts import FileFacts, SyntaxFault
from roslens.source.syntax.lines import BYTE_ORDER_MARKS, count_lines
from roslens.source.syntax.macro.macros import MacroPreset
from roslens.source.syntax.query.cpp_query import Captures, fault_nodes, parse_tree
from roslens.source.syntax.text_lines import TextLines
from roslens.source.syntax.tokens import hashes_of, squeezed_lines, token_text

_LONGEST_QUOTE = 60


@dataclass(frozen=True)
class CppTree:
    """A parsed file: its ``content``, the ``source`` that was parsed, of the same length, and its ``tree``.

    In ``source`` macros are blanked; ``repaired`` tells whether more was, to make something of what did not parse.
    """

    content: bytes
    source: bytes
    tree: Tree
    repaired: bool

    @cached_property
    def code(self) -> tuple[bytes, bool]:
        """The content with its comments blanked, and whether its line ends are plain; see :func:`blank_cpp`."""
        return blank_cpp(self.content)

    @cached_property
    def lines(self) -> TextLines:
        """The lines of the content."""
        return TextLines(self.content)


def tree_of_cpp(content: bytes, macros: MacroPreset) -> CppTree:
    """Parse a C or C++ file; the grammar of C++ reads both.

    Args:
        content: the bytes of the file.
        macros: what to blank before the parse; positions stay those of ``content``.
    """
    blanked = macros.blank(content)
    tree = parse_tree(blanked)
    if not tree.root_node.has_error:
        return CppTree(content, blanked, tree, repaired=False)
    source, tree = repaired(blanked, tree, macros)
    return CppTree(content, source, tree, repaired=source is not blanked)


def parse_cpp(content: bytes, macros: MacroPreset) -> FileFacts:
    """Parse a C or C++ file and return its facts, as :func:`tree_of_cpp` and :func:`facts_of_cpp` do."""
    return facts_of_cpp(tree_of_cpp(content, macros))


def facts_of_cpp(parsed: CppTree, captures: Captures | None = None) -> FileFacts:
    """Return the facts of a C or C++ file.

    Never fails: what cannot be parsed becomes a :class:`~roslens.source.syntax.facts.SyntaxFault`, and the
    functions it stands in are marked approximate.

    Args:
        parsed: the file.
        captures: of its tree, where they are there already.
    """
    content, source, tree = parsed.content, parsed.source, parsed.tree
    captures = Captures(source, tree) if captures is None else captures
    code, plain = parsed.code
    walk = Walk(source, code, captures)
    lines = LineMap(parsed.lines, squeezed_lines(code))
    lines.leave_out(captures.not_executed, captures.statements)
    if parsed.repaired:
        lines.leave_only(hashes_of(blank_cpp(source)[0])[1])
    faults = _faults(source, tree, lines)
    assembly = Assembly(source, token_text(code, "cpp"), lines, captures, walk, faults)
    return FileFacts(
        syntax="cpp",
        lines=lines.whole() if plain and not content.startswith(BYTE_ORDER_MARKS) else count_lines(content, "cpp"),
        halstead=assembly.halstead(),
        functions=tuple(map(assembly.function, walk.functions)),
        classes=tuple(map(assembly.of_class, walk.classes)),
        top_level=assembly.counts(),
        includes=tuple((text_of(source[start:end]), lines.number(start)) for start, end in captures.includes),
        line_hashes=lines.hashes,
        line_numbers=lines.numbers,
        faults=faults,
    )


def _faults(source: bytes, tree: Tree, lines: LineMap) -> tuple[SyntaxFault, ...]:
    faults = []
    for node in fault_nodes(tree):
        start, end = node.byte_range
        if node.is_missing:
            text = f"{node.type} is missing"
        else:
            text = " ".join(text_of(source[start : min(end, start + _LONGEST_QUOTE)]).split())
        line = lines.number(start)
        last = max(lines.number(max(end - 1, start)), line)
        faults.append(SyntaxFault(line, start - lines.start(line) + 1, last, text))
    return tuple(faults)
