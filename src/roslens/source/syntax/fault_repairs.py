"""What is tried where a C++ file still does not parse: macros recognised by where they stand, near the places alone.

Three names in a row, a name in capitals behind parameters, words in the parentheses of a macro that are no expressions:
at a place that does not parse they can be nothing but macros. Each kind is tried by itself and kept where it leaves
fewer faults, so that what parses stays as it is. A macro that was recognised at one place is one in the whole file.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator

from tree_sitter import Node, Tree

from roslens.source.syntax.comments import blank_comments
from roslens.source.syntax.macro.macro_edits import behind_arguments, fill
from roslens.source.syntax.macro.macro_places import BEHIND_PARAMETERS, GOES_ON, KINDS, MACRO, NO_TYPES, MacroKind
from roslens.source.syntax.query.cpp_query import parse_again

Span = tuple[int, int]
Edit = tuple[int, int, bytes]

_ROUNDS = 4
_MOST_FAULTS = 2_000
_MOST_NAMES = 20
_LONG = 20
"""A fault of so many rows is as bad as two small ones; the places in it are looked at instead."""
_MOST_PARSED_BYTES = 20_000_000
"""So much is parsed again for a file at most, though a parse of what changed costs less."""
_LONGEST_COMMENT = 5_000
_LONGEST_STATEMENT = 1_000
_MOST_UNCLOSED = 20
_LONGEST_CALL = 3_000
_NEAR = 200
_STEERING = frozenset({b"if", b"while", b"for", b"switch", b"catch"})
_CALL = re.compile(rb"(?<![\w.:>])([A-Z][A-Z0-9_]{2,}\w*)\s*\(")
_BEHIND_CALL = re.compile(GOES_ON)
_BESIDE_TEXT = re.compile(rb"\"\s*([A-Za-z_]\w*)(?=\s*[;,)]|\s+\")|[(,]\s*([A-Za-z_]\w*)\s+(?=\")")
_STRAY = re.compile(rb"(\\)(?=[ \t]+\r?$)", re.MULTILINE)
_STATEMENT_BEFORE = re.compile(rb"[;{})>:]\s*\Z|\A\s*\Z")
_DIRECTIVE = re.compile(rb"[ \t]*#[ \t]*(\w*)")
_CONDITION = re.compile(rb"[ \t]*#[ \t]*(?:el)?if\b[ \t]*")
_WORD_BEFORE = re.compile(rb"(\w+)\s*\Z")


class _Text:
    """A source with its comments blanked, and the macros in it."""

    def __init__(self, source: bytes) -> None:
        self.source = source
        self.code = blank_comments(source, "cpp")
        self._unclosed = 0

    def macros(self, start: int, end: int) -> Iterator[tuple[int, int, int]]:
        """Yield where names in capitals outside of directives begin and end, and where their arguments end."""
        code = self.code
        for match in MACRO.finditer(code, start, end):
            first, last = match.span()
            if not _in_directive(code, first):
                yield first, last, self.behind(last)

    def behind(self, last: int) -> int:
        """Return where the arguments of a name end that ends at ``last``; that itself where they do not end."""
        if self._unclosed > _MOST_UNCLOSED:
            return last
        end = behind_arguments(self.code, last)
        self._unclosed += end < 0
        return max(last, end)


def repaired_near_faults(source: bytes, tree: Tree) -> tuple[bytes, Tree]:
    """Return source and tree with fewer faults, where macros are recognised near them; every byte keeps its place."""
    repair = _Repair(_Text(source), tree)
    for _ in range(_ROUNDS):
        before = repair.fewest
        for rule in _RULES:
            faults = repair.faults
            if not faults or len(faults) > _MOST_FAULTS or repair.left < 0:
                return repair.text.source, repair.tree
            edits = list(rule(repair.text, faults))
            if edits and not repair.attempt(edits):
                repair.attempt_each(edits)
        if repair.fewest in (0, before):
            break
    return repair.text.source, repair.tree


class _Repair:
    """A source on its way to fewer faults."""

    def __init__(self, text: _Text, tree: Tree) -> None:
        self.text = text
        self.tree = tree
        self.faults = _all_faults(tree)
        self.fewest = _badness(self.faults)
        self.left = _MOST_PARSED_BYTES

    def attempt(self, edits: Iterable[Edit]) -> bool:
        """Keep what edits make where that has fewer faults; return whether it has."""
        edited = bytearray(self.text.source)
        for start, end, with_ in edits:
            fill(edited, start, end, with_)
        if edited == self.text.source:
            return True
        self.left -= len(edited)
        tree = parse_again(bytes(edited), self.text.source, self.tree)
        faults = _all_faults(tree)
        found = _badness(faults)
        if found >= self.fewest:
            return False
        self.text, self.tree, self.faults, self.fewest = _Text(bytes(edited)), tree, faults, found
        return True

    def attempt_each(self, edits: Iterable[Edit]) -> None:
        """Attempt the edits of each name by themselves: one that is no macro keeps none of the others."""
        by_name: dict[bytes, list[Edit]] = {}
        for edit in edits:
            by_name.setdefault(_name(self.text.source[edit[0] : edit[1]]), []).append(edit)
        for several in by_name.values() if 1 < len(by_name) <= _MOST_NAMES else ():
            if self.left >= 0:
                self.attempt(several)


def _all_faults(tree: Tree) -> list[Node]:
    """Return the places that could not be parsed, in source order; of a long one also those in it."""
    found = []
    waiting = [tree.root_node]
    while waiting:
        node = waiting.pop()
        rows = node.end_point.row - node.start_point.row
        fault = node.is_error or node.is_missing
        if fault and (rows < _LONG or node.child_count == 0):
            found.append(node)
        elif node.has_error:
            found += [node] if fault else []
            waiting += node.children
    found.sort(key=lambda node: (node.start_byte, -node.end_byte))
    return found


def _badness(faults: Iterable[Node]) -> int:
    return sum(1 + (fault.end_point.row - fault.start_point.row) // _LONG for fault in faults)


def _name(written: bytes) -> bytes:
    return written.partition(b"(")[0].strip()


def _windows(code: bytes, faults: Iterable[Node]) -> list[Span]:
    """Return the extents of faults with the lines around them, those that touch as one."""
    found: list[Span] = []
    for fault in faults:
        start, end = fault.byte_range
        end = start if fault.end_point.row - fault.start_point.row >= _LONG else end
        # Before a fault there may be a comment, and before that what causes it.
        line = code.rfind(b"\n", 0, start) + 1
        before = len(code[max(0, line - _LONGEST_COMMENT) : line].rstrip()) + max(0, line - _LONGEST_COMMENT)
        begin = max(code.rfind(sign, max(0, before - _LONGEST_STATEMENT), before - 1) for sign in b";{}")
        first = code.rfind(b"\n", 0, max(0, min(before, begin))) + 1
        last = end
        for _ in range(2):
            last = code.find(b"\n", last) + 1 or len(code)
        if found and found[-1][1] >= first:
            found[-1] = (found[-1][0], max(found[-1][1], last))
        else:
            found.append((first, last))
    return found


Rule = Callable[[_Text, list[Node]], Iterator[Edit]]


def _of_kind(kind: MacroKind) -> Rule:
    """Return a rule that takes away the macros of a kind."""

    def rule(text: _Text, faults: list[Node]) -> Iterator[Edit]:
        found = {
            macro: text.code[macro[0] : macro[1]]
            for start, end in _windows(text.code, faults)
            for macro in text.macros(start, end)
            if _is_of(kind, text.code, *macro)
        }
        everywhere = _others_named(text, kind, frozenset(found.values())) if found and kind.everywhere else ()
        for start, last, end in dict.fromkeys((*found, *everywhere)):
            yield last if kind.a_type else start, last if kind.name_only else end, b""

    return rule


def _others_named(text: _Text, kind: MacroKind, names: frozenset[bytes]) -> Iterator[tuple[int, int, int]]:
    """Yield the macros of a kind with one of some names, wherever they stand."""
    for macro in text.macros(0, len(text.code)):
        if text.code[macro[0] : macro[1]] in names and _is_of(kind, text.code, *macro):
            yield macro


def _is_of(kind: MacroKind, code: bytes, start: int, last: int, end: int) -> bool:
    if (kind.given and end == last) or not kind.behind.match(code, end):
        return False
    if kind.before is None:
        return True
    before = kind.before.search(code[max(0, start - _NEAR) : start])
    if before is None:
        return False
    if kind is BEHIND_PARAMETERS:
        closing = start - len(before[0])
        opening = _opening(code, closing)
        word = _WORD_BEFORE.search(code[max(0, opening - _NEAR) : opening])
        return word is None or word[1] not in _STEERING
    return not before.re.groups or before[1] not in NO_TYPES


def _opening(code: bytes, closing: int) -> int:
    depth = 0
    for place in range(closing, max(0, closing - _LONGEST_CALL), -1):
        sign = code[place]
        depth += (sign == 0x29) - (sign == 0x28)
        if not depth:
            return place
    return 0


def _given(text: _Text, faults: list[Node]) -> Iterator[Edit]:
    """Blank what macros are given where that does not parse, outside of functions the macro too."""
    code = text.code
    calls: dict[int, Edit] = {}
    names: set[bytes] = set()
    for fault in faults:
        found = _call_around(text, fault.start_byte)
        if found is None:
            continue
        start, opening, closing = found
        end = _end_of_statement(code, fault, start, closing)
        if end is None:
            calls[start] = (opening + 1, closing - 1, b"")
        else:
            calls[start] = (start, end, b"")
            names.add(code[start:opening].strip())
    for start, last, end in text.macros(0, len(code)) if names else ():
        behind = _BEHIND_CALL.match(code, end)
        alone = behind is None or behind[0].endswith(b";")
        if code[start:last] in names and alone and _STATEMENT_BEFORE.search(code[max(0, start - _NEAR) : start]):
            calls.setdefault(start, (start, behind.end() if behind else end, b""))
    yield from calls.values()


def _end_of_statement(code: bytes, fault: Node, start: int, closing: int) -> int | None:
    """Return where a call ends that is a statement outside of functions; None where it is none."""
    if _STATEMENT_BEFORE.search(code, max(0, start - _LONGEST_CALL), start) is None:
        return None
    behind = _BEHIND_CALL.match(code, closing)
    if behind is None:
        return closing
    return behind.end() if behind[0].endswith(b";") and not _in_function(fault) else None


def _call_around(text: _Text, position: int) -> tuple[int, int, int] | None:
    """Return where the innermost call of a macro around a position begins, opens and ends."""
    code, first = text.code, max(0, position - _LONGEST_CALL)
    for match in reversed(list(_CALL.finditer(code, first, min(len(code), position + 100)))):
        if match.start() > position or _in_directive(code, match.start()):
            continue
        end = text.behind(match.end(1))
        if end > position:
            return match.start(1), match.end() - 1, end
    return None


def _in_function(node: Node) -> bool:
    above = node.parent
    while above is not None:
        if above.type == "compound_statement":
            return True
        if above.type in ("field_declaration_list", "declaration_list"):
            return False
        above = above.parent
    return False


def _directives(text: _Text, faults: list[Node]) -> Iterator[Edit]:
    """Blank directives that do not parse; a condition is taken to hold."""
    source = text.source
    done: set[int] = set()
    for fault in faults:
        start = _logical_line(source, fault.start_byte)
        directive = _DIRECTIVE.match(source, start)
        if directive is None or start in done:
            continue
        done.add(start)
        end = _logical_end(source, fault.start_byte)
        condition = _CONDITION.match(source, start)
        if condition is not None:
            yield condition.end(), end, b"1"
        elif directive[1] in (b"", b"define", b"pragma", b"error", b"warning"):
            yield start, end, b""


def _logical_line(source: bytes, position: int) -> int:
    start = source.rfind(b"\n", 0, position) + 1
    while start > 1 and source[max(0, start - _NEAR) : start].rstrip()[-1:] == b"\\":
        start = source.rfind(b"\n", 0, start - 1) + 1
    return start


def _logical_end(source: bytes, position: int) -> int:
    end = source.find(b"\n", position)
    while end > 0 and source[max(0, end - _NEAR) : end].rstrip()[-1:] == b"\\":
        end = source.find(b"\n", end + 1)
    return len(source) if end < 0 else end


def _stray(text: _Text, faults: list[Node]) -> Iterator[Edit]:
    """Blank a backslash that continues no line, as a comment is behind it."""
    code = text.code
    for start, end in _windows(code, faults):
        for match in _STRAY.finditer(code, start, end):
            yield (*match.span(1), b"")


def _without_semicolons(text: _Text, faults: list[Node]) -> Iterator[Edit]:
    """Give a macro that stands for a statement its semicolon; one that a block follows is a loop or nothing."""
    code = text.code
    for fault in faults:
        if not fault.is_missing or fault.type != ";":
            continue
        end = len(code[max(0, fault.start_byte - _LONGEST_COMMENT) : fault.start_byte].rstrip())
        end += max(0, fault.start_byte - _LONGEST_COMMENT)
        found = _call_before(code, end)
        if found is None:
            continue
        name, opening = found
        start = opening - len(name[0])
        if code[end : end + _NEAR].lstrip()[:1] == b"{":
            yield start, end, b"for(;;)" if b"for" in name[1].lower() else b""
        elif end - opening == 2:
            yield start, end, b""
        elif code[end - 2] not in b"\r\n":
            yield opening + 1, end - 2, b""
            yield end - 2, end, b");"


def _call_before(code: bytes, end: int) -> tuple[re.Match[bytes], int] | None:
    """Return the name of a call that ends at ``end`` and begins a statement, and where its arguments open."""
    opening = _opening(code, end - 1) if code[end - 1 : end] == b")" else 0
    name = _WORD_BEFORE.search(code[max(0, opening - _NEAR) : opening])
    if not opening or name is None or name[1] in _STEERING:
        return None
    start = opening - len(name[0])
    return (name, opening) if _STATEMENT_BEFORE.search(code[max(0, start - _NEAR) : start]) else None


def _beside_texts(text: _Text, faults: list[Node]) -> Iterator[Edit]:
    """Blank macros that stand for a part of a text."""
    for start, end in _windows(text.code, faults):
        for match in _BESIDE_TEXT.finditer(text.source, start, end):
            yield (*match.span(match.lastindex or 1), b"")


def _in_directive(code: bytes, position: int) -> bool:
    line = code.rfind(b"\n", 0, position) + 1
    return code[line:position].lstrip()[:1] == b"#"


_RULES: tuple[Rule, ...] = (_directives, *map(_of_kind, KINDS), _without_semicolons, _given, _beside_texts, _stray)
