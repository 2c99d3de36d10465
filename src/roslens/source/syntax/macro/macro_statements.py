"""Macros of a project that stand for whole statements, told from calls by what is missing: the semicolon.

``NAME(arguments)`` that begins with capitals, alone on its lines, between statements and without a semicolon can be
nothing but a macro. It is blanked like those of the preset; a call that goes on in the next line stays.
"""

from __future__ import annotations

import re

from roslens.source.syntax.comments import blank_comments
from roslens.source.syntax.macro.macro_edits import behind_arguments, fill

_CANDIDATE = re.compile(rb"^[ \t]*([A-Z][A-Z0-9_]{2,}\w*)(?=[ \t]*\()", re.MULTILINE)
_CONTINUED = re.compile(rb"\\\r?\n[ \t]*\Z")
_NEXT = re.compile(rb"[ \t\r]*(?:\n\s*(?:[A-Za-z_}#~]|::|\[\[|\*\w)|\s*\Z)")
_BEFORE = re.compile(rb"(?:[;{})>:]|\A)\s*\Z")
_DIRECTIVE = re.compile(rb"(?:\A|\n)[ \t]*#[^\n]*\s*\Z")
_NEAR = 1_000
_MOST_UNCLOSED = 20


def blank_statements(content: bytes) -> bytes:
    """Return ``content`` without statements that only macros can be; lengths and line breaks stay."""
    if not _CANDIDATE.search(content):
        return content
    code = blank_comments(content, "cpp")
    text, done, unclosed = bytearray(content), 0, 0
    for match in _CANDIDATE.finditer(code):
        start, end = match.span(1)
        near = max(0, start - _NEAR)
        between = _BEFORE.search(code, near, start) or any(
            _DIRECTIVE.search(one, near, start) for one in (code, content)
        )
        if start < done or not between or _CONTINUED.search(content, near, start):
            continue
        last = behind_arguments(code, end)
        if last > 0 and _NEXT.match(code, last):
            fill(text, start, last)
            done = last
        unclosed += last < 0
        if unclosed > _MOST_UNCLOSED:
            break
    return bytes(text)
