"""One parse of a file, for all that read it: facts for metrics, and the program from which a graph is extracted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache, cached_property
from typing import TYPE_CHECKING, Protocol

from roslens.model.source import Language
from roslens.source.settings import MacroSettings
from roslens.source.syntax.facts import FileFacts
from roslens.source.syntax.macro.macros import MacroPreset, load_macros

if TYPE_CHECKING:
    from tree_sitter import Node

    from roslens.source.extract.ir.program import Program
    from roslens.source.rules.file_view import FileView

_preset = cache(load_macros)


def macro_preset(settings: MacroSettings) -> MacroPreset:
    """Return the macros to blank, compiled once per process and settings."""
    return _preset(settings)


class ParsedFile(Protocol):
    """A file that was parsed once; each answer is made of the same tree.

    Attributes:
        syntax: ``cpp`` or ``python``.
    """

    syntax: str

    def facts(self, kinds: frozenset[str] = frozenset()) -> FileFacts:
        """Return what metrics are made of.

        ``kinds`` are the types of nodes that rules will ask for: the view that is taken afterwards has those that the
        same pass through the tree met.
        """

    def program(self) -> Program:
        """Return the facts about nodes, topics and parameters."""

    def view(self) -> FileView:
        """Return the file as rules see it."""


class _ParsedCpp:
    syntax = "cpp"

    def __init__(self, content: bytes, macros: MacroPreset) -> None:
        from roslens.source.syntax.cpp import tree_of_cpp

        self._parsed = tree_of_cpp(content, macros)
        self._of_kinds: Mapping[str, Sequence[Node]] = {}

    def facts(self, kinds: frozenset[str] = frozenset()) -> FileFacts:
        from roslens.source.syntax.cpp import facts_of_cpp
        from roslens.source.syntax.query.cpp_query import Captures

        captures = Captures(self._parsed.source, self._parsed.tree, kinds)
        self._of_kinds = captures.of_kinds
        return facts_of_cpp(self._parsed, captures)

    def program(self) -> Program:
        from roslens.source.extract.lowering.cpp.cpp_program import lower_cpp

        return lower_cpp(self._parsed.source, self._parsed.tree, self._parsed.content)

    def view(self) -> FileView:
        from roslens.source.rules.file_view import FileView

        parsed = self._parsed
        root = parsed.tree.root_node
        return FileView("cpp", parsed.content, parsed.source, parsed.code[0], root, self._of_kinds, parsed.lines)


class _ParsedPython:
    syntax = "python"

    def __init__(self, content: bytes) -> None:
        from roslens.source.syntax.python_tree import parse_tree, with_line_feeds

        self._content = content
        self._text = with_line_feeds(content)
        self._parsed = parse_tree(self._text)

    @cached_property
    def _code(self) -> bytes:
        from roslens.source.syntax.comments import blank_comments

        return blank_comments(self._text, "python")

    def facts(self, kinds: frozenset[str] = frozenset()) -> FileFacts:  # noqa: ARG002 - its trees are small
        from roslens.source.syntax.python import facts_of_python

        return facts_of_python(self._content, self._parsed, self._code)

    def program(self) -> Program:
        from roslens.source.extract.lowering.python.python_program import lower_python

        return lower_python(self._parsed)

    def view(self) -> FileView:
        from roslens.source.rules.file_view import FileView

        return FileView("python", self._text, self._parsed.source, self._code, self._parsed.tree.root_node)


def parse_file(content: bytes, language: Language, macros: MacroSettings) -> ParsedFile:
    """Parse ``content`` once.

    Raises:
        ValueError: the language has no syntax.
    """
    syntax = language.parsed_as
    if syntax == "cpp":
        return _ParsedCpp(content, macro_preset(macros))
    if syntax == "python":
        return _ParsedPython(content)
    raise ValueError(f"{language.value!r} has no syntax; expected C, C++ or Python")
