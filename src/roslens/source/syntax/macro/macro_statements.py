"""Macros of a project that stand for whole statements, distinguished from calls by what is missing: the semicolon.

``NAME(arguments)`` that begins with capitals, alone on its lines, between statements and without a semicolon can be
nothing but a macro. It is blanked like those of the preset; a call that goes on in the next line stays.
"""

from __future__ import annotations

import re

from roslens.source.syntax.comments import blank_comments
from roslens.source.syntax.macro.macro_edits import behind_arguments, fill

_CANDIDATE = re.compile(rb"^[ \t]*([A-Z][A-Z0-9_]{2,}\w*)(?=[ \t]*\()", re.MULTILINE)
_NEXT = re.compile(rb"[ \t\r]*(?:\n\s*(?:[A-Za-z_}#~]|::|\[\[|\*\w)|\s*\Z)")
_ENDS = frozenset(b";{})>:")
_CONTINUING = (b"\\\n", b"\\\r\n")
_NEAR = 1_000
_MOST_UNCLOSED = 20


def _is_between(code: bytes, content: bytes, near: int, start: int) -> bool:
    """Return whether a place stands between statements: behind the end of one, or behind a directive."""
    before = content[near:start]
    if before.rstrip(b" \t").endswith(_CONTINUING):
        return False
    behind = code[near:start].rstrip()
    if behind[-1] in _ENDS if behind else not near:
        return True
    return _is_directive(behind, near) or _is_directive(before.rstrip(), near)


def _is_directive(text: bytes, start: int) -> bool:
    """Return whether the last line of a text is a directive; where the text begins amid a file, it has to be whole."""
    line = text.rfind(b"\n")
    return (line >= 0 or not start) and text[line + 1 :].lstrip(b" \t").startswith(b"#")


def blank_statements(content: bytes) -> bytes:
    """Return ``content`` without statements that only macros can be; lengths and line breaks stay."""
    if not _CANDIDATE.search(content):
        return content
    code = blank_comments(content, "cpp")
    text, done, unclosed = bytearray(content), 0, 0
    for match in _CANDIDATE.finditer(code):
        start, end = match.span(1)
        near = max(0, start - _NEAR)
        if start < done or not _is_between(code, content, near, start):
            continue
        last = behind_arguments(code, end)
        if last > 0 and _NEXT.match(code, last):
            fill(text, start, last)
            done = last
        unclosed += last < 0
        if unclosed > _MOST_UNCLOSED:
            break
    return bytes(text)
