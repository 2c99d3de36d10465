"""A parsed file as rules see it."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import cast

from tree_sitter import Node

from roslens.model.edit import Edit, place_of
from roslens.model.weight.consequence import Certainty
from roslens.model.words.shortened import shortened
from roslens.source.rules.hit import Hit
from roslens.source.syntax.text_lines import TextLines

_LONGEST_CONTEXT = 200
_LARGE = 1000
_WORDS = bytes(byte if byte < 0x80 and (chr(byte).isalnum() or chr(byte) == "_") else 0x20 for byte in range(256))
_CPP_ALONE = frozenset((b"namespace", b"class", b"template", b"typename", b"virtual", b"nullptr", b"operator"))
_OPEN = frozenset(
    (
        *("namespace_definition", "declaration_list", "linkage_specification"),
        *("preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif"),
    )
)


class FileView:
    """One file: its tree and its text.

    Attributes:
        syntax: ``cpp`` or ``python``.
        source: what was parsed; positions of nodes are positions in it.
        code: the same length with comments blanked and each string one word.
        root: of the tree.
        of_kinds: nodes by their type or shape, of those that were looked for with the metrics.
    """

    def __init__(
        self,
        syntax: str,
        content: bytes,
        source: bytes,
        code: bytes,
        root: Node,
        of_kinds: Mapping[str, Sequence[Node]] | None = None,
        text_lines: TextLines | None = None,
    ) -> None:
        """Take what the one parse gave; ``content`` is the file as it is, ``text_lines`` its lines if known."""
        self.syntax = syntax
        self.content = content
        self.source = source
        self.code = code
        self.root = root
        self.of_kinds = of_kinds or {}
        self._text_lines = text_lines or TextLines(content)
        self._mentioned: dict[bytes, bool] = {}

    @property
    def lines(self) -> list[bytes]:
        """The lines of the content, without what ends them."""
        return self._text_lines.lines

    @cached_property
    def words(self) -> frozenset[bytes]:
        """The words of the code, of its strings too; a set is quicker to ask than the code for hundreds of them."""
        return frozenset(self.code.translate(_WORDS).split())

    def mentions(self, parts: Sequence[bytes]) -> bool:
        """Return whether one of some texts stands anywhere in the file; each is looked for once."""
        known = self._mentioned
        for part in parts:
            if part not in known:
                known[part] = part in self.content
        return any(known[part] for part in parts)

    def has(self, pattern: re.Pattern[bytes]) -> bool:
        """Return whether a pattern matches anywhere in the code; it is looked for once."""
        key = ("has", pattern)
        if key not in self.kept:
            self.kept[key] = pattern.search(self.code) is not None
        return bool(self.kept[key])

    def names(self, pattern: re.Pattern[bytes]) -> frozenset[bytes]:
        """Return what the one group of a pattern matches in the code; it is looked for once, whatever name is asked."""
        key = ("names", pattern)
        if key not in self.kept:
            self.kept[key] = frozenset(pattern.findall(self.code))
        return cast("frozenset[bytes]", self.kept[key])

    @cached_property
    def top_level(self) -> list[Node]:
        """What stands at the level of the file or of a named namespace, in order; in ``#if`` as well."""
        found, waiting = [], list(reversed(self.root.children))
        while waiting:
            node = waiting.pop()
            if node.type == "namespace_definition" and node.child_by_field_name("name") is None:
                continue
            if node.type in _OPEN:
                waiting.extend(reversed(node.children))
            else:
                found.append(node)
        return found

    @cached_property
    def may_be_header(self) -> bool:
        """Whether something keeps the file from being read twice, as headers do; sources may pass."""
        return b"#pragma once" in self.code or b"#ifndef" in self.code or b"!defined" in self.code

    @cached_property
    def is_cpp_alone(self) -> bool:
        """Whether no compiler of C can read the file."""
        is_other = not _CPP_ALONE.isdisjoint(self.words) or b"::" in self.code
        return is_other and b"__cplusplus" not in self.code

    @cached_property
    def kept(self) -> dict[object, object]:
        """What rules worked out and ask again, by keys of their own."""
        return {}

    def nodes(self, kind: str) -> Sequence[Node]:
        """Return the nodes of a type or shape that some rule asks for or gathers."""
        return self.of_kinds.get(kind, ())

    def text(self, node: Node | None) -> str:
        """Return the source of a node with its white space squeezed, and none inside of parentheses; empty for none."""
        if node is None:
            return ""
        text = self.source[node.start_byte : node.end_byte].decode("utf-8", "replace")
        if text.isidentifier():
            return text
        text = " ".join(text.split())
        return text.replace("( ", "(").replace(" )", ")") if "( " in text or " )" in text else text

    def short(self, node: Node | None, most: int = 60) -> str:
        """Return the source of a node for a message: at most so many characters, cut between words."""
        return shortened(self.text(node), most)

    def _context(self, node: Node) -> str:
        """Return the beginning of the text of a node, without reading all of a large one."""
        start, end = node.byte_range
        if end - start > _LARGE:
            text = " ".join(self.source[start : start + _LARGE].decode("utf-8", "replace").split())
            # The last character may have been cut in two.
            if len(text) > _LONGEST_CONTEXT:
                return text[:_LONGEST_CONTEXT]
        return " ".join(self.source[start:end].decode("utf-8", "replace").split())[:_LONGEST_CONTEXT]

    def place(self, position: int) -> tuple[int, int]:
        """Return the line and column, both 1-based, of a position in bytes."""
        starts = self._text_lines.starts
        row = bisect_right(starts, position)
        return row, position - starts[row - 1] + 1

    def node_at(self, start: int, end: int) -> Node | None:
        """Return the smallest node around an extent in bytes."""
        return self.root.descendant_for_byte_range(start, end)

    def hit(
        self,
        rule: str,
        node: Node,
        message: str,
        *,
        only: str = "",
        callback: str = "",
        certainty: Certainty | None = None,
        edits: tuple[Edit, ...] = (),
    ) -> Hit:
        """Return a hit at a node; see :class:`Hit` for the rest."""
        row, offset = node.start_point
        line, column = row + 1, offset + 1
        end_row, end_column = node.end_point
        end_line = end_row + 1
        if (
            not end_column or node.end_byte == node.start_byte
        ):  # its last byte stands in the line before, or is its first
            end_line, end_column = self.place(max(node.end_byte - 1, node.start_byte))
        context = self._context(node)
        return Hit(
            rule,
            message,
            line,
            column,
            end_line,
            end_column,
            context,
            only=only,
            callback=callback,
            certainty=certainty,
            edits=edits,
        )

    def hit_at(
        self, rule: str, line: int, message: str, *, column: int = 0, only: str = "", edits: tuple[Edit, ...] = ()
    ) -> Hit:
        """Return a hit at a line."""
        text = self.lines[line - 1] if 0 < line <= len(self.lines) else b""
        context = " ".join(text.decode("utf-8", "replace").split())[:_LONGEST_CONTEXT]
        return Hit(rule, message, line, column, context=context, only=only, edits=edits)

    def edits(self, *changes: tuple[int, int, str]) -> tuple[Edit, ...]:
        """Return edits that put texts into the place of bytes, each change ``(start, end, text)``.

        None where what was parsed is not what the file holds there: a macro that was blanked, a place that was
        repaired. Then nobody knows what the change would mean.
        """
        found = []
        for start, end, text in changes:
            if self.source[start:end] != self.content[start:end]:
                return ()
            found.append(Edit("", start, end, text, *self._edit_place(start), *self._edit_place(end)))
        return tuple(found)

    def _edit_place(self, at: int) -> tuple[int, int]:
        """Return what :func:`place_of` does, which counts all lines before."""
        row, column = self.place(at)
        return (row, column) if self.content[at - column + 1 : at].isascii() else place_of(self.content, at)

    def is_as_written(self, node: Node) -> bool:
        """Return whether a node was parsed without a fault, and as the file holds it."""
        start, end = node.start_byte, node.end_byte
        return not node.has_error and self.source[start:end] == self.content[start:end]


def above(node: Node, *types: str) -> Node | None:
    """Return the nearest node around ``node`` of one of the types."""
    found = node.parent
    while found is not None and found.type not in types:
        found = found.parent
    return found


def all_above(node: Node) -> Iterator[Node]:
    """Yield the nodes around ``node``, the nearest first."""
    found = node.parent
    while found is not None:
        yield found
        found = found.parent


def below(node: Node, *types: str, inside: tuple[str, ...] = ()) -> Iterator[Node]:
    """Yield the nodes below ``node`` of one of the types, in source order; not below nodes of a type of ``inside``.

    The walk keeps its own stack: sources are nested deeper than Python calls can be.
    """
    waiting = list(reversed(node.children))
    while waiting:
        one = waiting.pop()
        if one.type in types:
            yield one
        if one.type not in inside:
            waiting.extend(reversed(one.children))
