r"""Source with its comments blanked in place: same length, same line breaks, so that positions hold.

What is left is made safe to cut up with plain byte operations, which is what makes counting tokens and hashing
lines cheap:

- a comment is spaces; so is a Python docstring (a triple-quoted string that stands alone on its lines);
- a string, a character or the target of an ``#include`` is one run of *word bytes*: each byte that would
  separate words is replaced by its counterpart above 0x7F (:data:`LINE_BREAK_IN_STRING` for a line break);
- a backslash before a line end, carriage returns, other control characters are spaces.
"""

from __future__ import annotations

import re
from itertools import compress, count, repeat
from operator import contains, itemgetter

LINE_BREAK_IN_STRING = 0xFF
"""Stands for a line break inside a string; the byte never occurs in UTF-8."""

_WHITE = b"\t\v\f\r "
_ESCAPED_BACKSLASH, _ESCAPED_QUOTE, _ESCAPED_APOSTROPHE = b"\x03\x03", b"\x04\x04", b"\x05\x05"
_CONTINUATION = b"\x01\x02"
"""A backslash and the line end behind it; the second byte becomes a line break again."""


def _cleaned(byte: int) -> int:
    if byte == LINE_BREAK_IN_STRING:
        return 0xFD
    return 0x20 if (byte < 0x20 and byte not in b"\t\n") or byte == 0x7F else byte


def _in_string(byte: int) -> int:
    if byte in {0x0A, _CONTINUATION[1]}:
        return LINE_BREAK_IN_STRING
    if byte >= 0x80 or chr(byte).isalnum() or byte == 0x5F:
        return byte
    return byte | 0x80


_CLEANED = bytes(map(_cleaned, range(256)))
_IN_STRING = bytes(map(_in_string, range(256)))
_IN_COMMENT = bytes(0x0A if byte in {0x0A, _CONTINUATION[1]} else 0x20 for byte in range(256))
_OUTSIDE = bytes(0x0A if byte == _CONTINUATION[1] else 0x20 if byte < 0x06 else byte for byte in range(256))

_BLOCK_COMMENT = rb"/\*[^*]*(?:\*(?!/)[^*]*)*(?:\*/|\Z)"
_BLOCK_COMMENT_OF_MANY_STARS = rb"/\*.*?(?:\*/|\Z)"
MANY_STARS = 100_000
"""Stars beyond which the quick pattern for block comments would need a hundred megabytes."""
_CPP = (
    rb"""//[^\n]*|%s|"[^"\n]*"?|'(?:[^'\n]{1,12}')?|#[ \t]{0,40}include[ \t]{0,40}(?:<[^>\n]{1,200}>|"[^"\n]{1,200}")"""
)
_RAW_STRING = rb'R"([^()\s"]{0,16})\(.*?\)\2"|'
_CPP_PARTS = re.compile(b"(" + _CPP % _BLOCK_COMMENT + b")", re.DOTALL)
_CPP_PARTS_WITH_RAW = re.compile(b"(" + _RAW_STRING + _CPP % _BLOCK_COMMENT + b")", re.DOTALL)
_CPP_PARTS_OF_MANY_STARS = re.compile(b"(" + _CPP % _BLOCK_COMMENT_OF_MANY_STARS + b")", re.DOTALL)
_SLASH, _LINE_END = ord("/"), ord("\n")
_IN_PART = [_IN_COMMENT if byte == _SLASH else _IN_STRING for byte in range(256)]
"""What becomes of a comment or string, by its first byte."""
_IS_STRING = bytes(byte != _SLASH for byte in range(256))
_RAW_SEARCH_LIMIT = 50_000_000
"""Raw strings opened and never closed make the search quadratic: starts times bytes beyond which it is left out."""
_DIGIT_SEPARATOR = re.compile(rb"'(?<=[0-9A-F]')(?<!u8')(?=[0-9A-F])")
_PYTHON_PARTS = re.compile(
    rb"""([\#"'](?:(?<=\#)[^\n\x02]*|(?<=")(?:"".*?(?:\"{3}|\Z)|[^"\n]*"?)|(?<=')(?:''.*?(?:'{3}|\Z)|[^'\n]*'?)))""",
    re.DOTALL,
)
"""One class of first bytes, distinguished behind it: the search for the next part is what takes the time."""
_TRIPLE_QUOTES = (b'"""', b"'''")
_NOTHING_FOLLOWS = re.compile(rb"[ \t]*(?:[\n#]|\Z)")
_REST_OF_LINE = re.compile(rb"[ \t]*(\n|\Z)")
_WIDEST_INDENT = 400


def blank_comments(content: bytes, syntax: str) -> bytes:
    """Return ``content`` with comments blanked and strings made words.

    Args:
        content: the bytes of a file, in any encoding that has ASCII in it.
        syntax: ``cpp`` (also C) or ``python``.
    """
    if syntax == "cpp":
        return blank_cpp(content)[0]
    text = b"".join(_python_parts(_PYTHON_PARTS.split(_without_escapes(content))))
    return text.translate(_OUTSIDE)


def blank_cpp(content: bytes) -> tuple[bytes, bool]:
    """Return ``content`` of C or C++ with comments blanked and strings made words, and whether it is *plain*.

    Of a plain file the lines that still hold something are as many as are left when comments are cut out by somebody
    who knows no strings: no string holds the sign of a comment, nothing stands behind a comment of several lines, no
    line is continued, no escape stands outside strings, and there are no control characters.
    """
    text = _without_escapes(content)
    if b"'" in text:
        text = _DIGIT_SEPARATOR.sub(b"_", text)
    pattern = _cpp_parts(text)
    found = pattern.split(text)
    if pattern.groups > 1:
        del found[2 :: pattern.groups + 1]
    parts = found[1::2]
    firsts = bytes(map(itemgetter(0), parts))
    found[1::2] = map(bytes.translate, parts, map(_IN_PART.__getitem__, firsts))
    text = b"".join(found)
    code = text.translate(_OUTSIDE)
    return code, pattern.groups == 1 and code == text and _has_plain_bytes(content) and _is_plain(parts, firsts, found)


def _has_plain_bytes(content: bytes) -> bool:
    """Return whether no line is continued, not even when a comment goes, and there are no control characters."""
    if content.translate(_CLEANED) != content:
        return False
    first = content.find(b"\\")
    return first < 0 or (content.find(b"\\\n", first) < 0 and content.find(b"\\/", first) < 0)


def _is_plain(parts: list[bytes], firsts: bytes, found: list[bytes]) -> bool:
    """Return whether every comment is also one without regard to strings, and ends its line if it has several."""
    if parts and parts[-1].startswith(b"/*") and not (parts[-1].endswith(b"*/") and len(parts[-1]) > len(b"/*/")):
        return False
    strings = b"".join(compress(parts, firsts.translate(_IS_STRING)))
    if b"//" in strings or b"/*" in strings:
        return False
    for place in compress(count(), map(contains, parts, repeat(_LINE_END))):
        rest = _REST_OF_LINE.match(found[2 * place + 2])
        if rest is None or (place + 1 < len(parts) and not rest[1]):
            return False
    return True


def _cpp_parts(text: bytes) -> re.Pattern[bytes]:
    """Choose the quickest pattern that is safe on ``text``."""
    if text.count(b"*") > MANY_STARS:
        return _CPP_PARTS_OF_MANY_STARS
    raw_starts = text.count(b'R"')
    return _CPP_PARTS_WITH_RAW if 0 < raw_starts * len(text) < _RAW_SEARCH_LIMIT else _CPP_PARTS


def _without_escapes(content: bytes) -> bytes:
    """Replace control characters and what follows a backslash, so that a string ends at the next quote."""
    if b"\r" in content:
        content = content.replace(b"\\\r\n", b"\\ \n").replace(b"\\ \n", b" \\\n")
    text = content.translate(_CLEANED)
    if b"\\" not in text:
        return text
    return (
        text.replace(b"\\\\", _ESCAPED_BACKSLASH)
        .replace(b'\\"', _ESCAPED_QUOTE)
        .replace(b"\\'", _ESCAPED_APOSTROPHE)
        .replace(b"\\\n", _CONTINUATION)
    )


def _python_parts(parts: list[bytes]) -> list[bytes]:
    """Blank comments and docstrings and make words of strings; every second part is one of these."""
    for place in range(1, len(parts), 2):
        part = parts[place]
        if part.startswith(b"#"):
            parts[place] = b" " * len(part)
        elif part.startswith(_TRIPLE_QUOTES) and _stands_alone(parts, place):
            parts[place] = part.translate(_IN_COMMENT)
            before = parts[place - 1].rstrip(b"rRuUbBfF")
            parts[place - 1] = before.ljust(len(parts[place - 1]))
        else:
            parts[place] = part.translate(_IN_STRING)
    return parts


def _stands_alone(parts: list[bytes], place: int) -> bool:
    """Return whether nothing but white space, a string prefix and a comment shares the lines of a part."""
    before, after = parts[place - 1], parts[place + 1]
    line_start = before.rfind(b"\n") + 1
    if (not line_start and place > 1) or before[line_start:].strip(_WHITE + b"rRuUbBfF"):
        return False
    line_end = after.find(b"\n")
    if line_end >= 0:
        return not after[:line_end].strip(_WHITE)
    return not after.strip(_WHITE) and (place + 2 >= len(parts) or parts[place + 2].startswith(b"#"))
