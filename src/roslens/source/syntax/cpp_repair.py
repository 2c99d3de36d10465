"""What is tried for a C++ file that does not parse: less of it, at the same places.

First the rarer macros are blanked. Then, where an ``#if`` splits a statement or a block between its arms, no tree can
hold both: only the first arm of each is left (of ``#if 0`` the second). What gives the fewest faults is taken. Where
there are faults all the same, what the grammar does not know is rewritten, and what is near them looked at.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import pairwise

from tree_sitter import Tree

from roslens.source.syntax.fault_repairs import repaired_near_faults
from roslens.source.syntax.macro.macros import MacroPreset
from roslens.source.syntax.query.cpp_query import fault_nodes, parse_again

_DIRECTIVE = re.compile(rb"^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|elifdef|elifndef|else|endif)\b[^\n]*", re.MULTILINE)
_DECLARED_BEHIND = rb"\)\s{0,80}((?:[A-Za-z_][\w\s*,\[\]]{1,200};\s{0,80}){1,40})\{"
_OLD_PARAMETERS = re.compile(rb"\b([A-Za-z_]\w{0,99})[ \t]*\(([\w\s,]{1,400})" + _DECLARED_BEHIND)
_MAYBE_OLD = re.compile(_DECLARED_BEHIND)
"""The end of :data:`_OLD_PARAMETERS`: found much sooner, as it begins with one fixed byte."""
_BLANK = bytes(byte if byte == 0x0A else 0x20 for byte in range(256))
_NO_FUNCTION = (b"if", b"while", b"for", b"switch", b"catch")
_WORD = re.compile(rb"[A-Za-z_]\w*")
_NEVER = re.compile(rb"[ \t]*#[ \t]*if[ \t]+0\b")
_ROWS = 50
"""A fault of so many rows is as bad as two small ones."""
_MOST_BYTES = 2_000_000
"""A larger file is taken as it parses: it was made by a program."""


def repaired(source: bytes, tree: Tree, macros: MacroPreset) -> tuple[bytes, Tree]:
    """Return the source and tree with the fewest faults; every byte keeps its place."""
    if len(source) > _MOST_BYTES:
        return source, tree
    fewest, best, last = _faults(tree), (source, tree), (source, tree)
    first = with_parameter_types(macros.repair(source))
    attempts: tuple[Callable[[bytes], bytes], ...] = (
        lambda text: text,
        first_arms,
        lambda text: _DIRECTIVE.sub(_spaces, first_arms(text)),
    )
    for attempt in attempts:
        text = attempt(first)
        if fewest and text != last[0]:
            last = (text, parse_again(text, *last))
            faults = _faults(last[1])
            if faults < fewest:
                fewest, best = faults, last
    if not fewest:
        return best
    text = macros.repair_last(best[0])
    if text != best[0]:
        changed = parse_again(text, *best)
        if _faults(changed) <= fewest:
            best = (text, changed)
    return repaired_near_faults(*best) if best[1].root_node.has_error else best


def _faults(tree: Tree) -> int:
    # Where nothing of a file fits together, all of it is one fault: namespaces and functions are lost.
    return sum(1 + (one.end_point.row - one.start_point.row) // _ROWS for one in fault_nodes(tree))


def with_parameter_types(source: bytes) -> bytes:
    """Return ``source`` with the parameters of C before 1989 as the grammar knows them.

    ``f(a, b) int a; char *b; {`` becomes ``f(     int a, char *b) {``: every byte that stays keeps its place.
    """
    if not _MAYBE_OLD.search(source):
        return source
    text = bytearray(source)
    for match in _OLD_PARAMETERS.finditer(source):
        names, declarations = match.span(2), match.span(3)
        if match[1] in _NO_FUNCTION or not set(_WORD.findall(match[2])) & set(_WORD.findall(match[3])):
            continue
        _blank(text, names[0], declarations[0])
        text[slice(*declarations)] = text[slice(*declarations)].replace(b";", b",")
        last = text.rindex(b",", *declarations)
        text[last : last + 1] = b")"
    return bytes(text)


def first_arms(source: bytes) -> bytes:
    """Return ``source`` with all but one arm of every ``#if`` blanked, where there are several."""
    text = bytearray(source)
    open_ifs: list[list[re.Match[bytes]]] = []
    for match in _DIRECTIVE.finditer(source):
        word = match[1]
        if word.startswith(b"if"):
            open_ifs.append([match])
        elif open_ifs:
            open_ifs[-1].append(match)
            if word == b"endif":
                _keep_one_arm(text, open_ifs.pop())
    return bytes(text)


def _keep_one_arm(text: bytearray, directives: list[re.Match[bytes]]) -> None:
    kept = 1 if _NEVER.match(directives[0][0]) else 0
    if len(directives) == 2 and kept == 0:
        return
    for number, (begin, end) in enumerate(pairwise(directives)):
        first = begin.start()
        last = begin.end() if number == kept else end.start()
        _blank(text, first, last)
    _blank(text, directives[-1].start(), directives[-1].end())


def _spaces(match: re.Match[bytes]) -> bytes:
    return b" " * len(match[0])


def _blank(text: bytearray, start: int, end: int) -> None:
    text[start:end] = text[start:end].translate(_BLANK)
