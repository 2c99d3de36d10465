"""Lines of code, comment and blank lines, distinguished exactly as cloc does.

cloc (https://github.com/AlDanial/cloc, measured against 1.96) knows no grammar: it drops blank lines, then runs a
few textual filters and calls what is left code; comment lines are the rest. To be equal for every file, what
its filters do is done here on purpose, surprises included:

- C and C++: a comment sign inside a string starts a comment; ``a /*`` … ``*/ b`` becomes one line of code; a blank
  line behind a line that ends with a backslash is not blank.
- Python: a line with ``/*`` or ``*/`` is a comment; triple quotes open and close a comment in turn, whatever
  stands before them, so ``x = \"\"\"`` is code and the lines behind it are comment; a first line ``#!`` is code.

The one difference: cloc gives up on a file that takes it longer than a second for each thousand lines.
"""

from __future__ import annotations

import re

from roslens.source.syntax.comments import MANY_STARS
from roslens.source.syntax.facts import Lines

BYTE_ORDER_MARKS = (
    b"\xfe\xff", b"\xff\xfe", b"\xef\xbb\xbf", b"\xf7\x64\x4c", b"\x0e\xfe\xff", b"\xfb\xee\x28",
    b"\x00\x00\xfe\xff", b"\x2b\x2f\x76\x38", b"\x2b\x2f\x76\x39", b"\x2b\x2f\x76\x2b", b"\x2b\x2f\x76\x2f",
    b"\xdd\x73\x66\x73", b"\x84\x31\x95\x33",
)  # fmt: skip
"""Bytes that are no part of the first line."""

_WHITE = b" \t\r\v\f"
_CPP_COMMENT = re.compile(rb"/(?:/[^\n]*|\*[^*]*(?:\*(?!/)[^*]*)*\*/)")
_CPP_COMMENT_WITH_LINE_END = re.compile(rb"/(?:/[^\n]*\n|\*[^*]*(?:\*(?!/)[^*]*)*\*/)")
_BLOCK_COMMENT = re.compile(rb"/\*.*?\*/", re.DOTALL)
_QUOTES = re.compile(rb"\"{3}|'{3}")
_TRIPLE_QUOTE = re.compile(rb"([uU]?)(?:\"\"\"|''')")


def count_lines(content: bytes, syntax: str) -> Lines:
    """Count the lines of a file as cloc does.

    Args:
        content: the bytes of the file.
        syntax: ``cpp`` (also C) or ``python``.

    Raises:
        ValueError: ``syntax`` is neither.
    """
    if syntax not in {"cpp", "python"}:
        raise ValueError(f"{syntax!r} is not a syntax with a line counter: expected 'cpp' or 'python'")
    text = _normalised(content)
    if not text:
        return Lines()
    continued = _is_continued(text)
    if syntax == "cpp" and not continued:
        rest = _removed(_CPP_COMMENT, text)
        if not _is_continued(rest):
            return _distinguished(text.count(b"\n"), _count_filled(text), _count_filled(rest))
    lines = text.split(b"\n")
    lines.pop()
    filled = _without_blanks(lines) if continued else list(filter(bytes.strip, lines))
    code = _continued_cpp_code(filled) if syntax == "cpp" else _python_code(text, filled)
    return _distinguished(len(lines), len(filled), code)


def _distinguished(physical: int, filled: int, code: int) -> Lines:
    return Lines(physical, code, filled - code, physical - filled)


def _normalised(content: bytes) -> bytes:
    """Return ``content`` without byte order mark and carriage returns, its last line ended."""
    if content and not content.endswith(b"\n"):
        content += b"\n"
    for mark in BYTE_ORDER_MARKS:
        if content.startswith(mark):
            content = content[len(mark) :]
            break
    return content.replace(b"\r\n", b"\n") if b"\r" in content else content


def _is_continued(text: bytes) -> bool:
    """Return whether a line ends with a backslash; one byte is found many times faster than two."""
    first = text.find(b"\\")
    return first >= 0 and text.find(b"\\\n", first) >= 0


def _without_blanks(lines: list[bytes]) -> list[bytes]:
    """Drop blank lines, but not those behind a line that ends with a backslash."""
    previous = b""
    kept = []
    for line in lines:
        if line.strip() or previous.endswith(b"\\"):
            kept.append(line)
        previous = line
    return kept


def _continued_cpp_code(filled: list[bytes]) -> int:
    """Count the lines that are left when comments are gone, where lines end with a backslash."""
    joined = b"".join([line + b"\n" if line.endswith(b"\\") else line + b"\n\n" for line in filled])
    return len(_without_blanks(_split(_removed(_CPP_COMMENT_WITH_LINE_END, joined))))


def _python_code(text: bytes, filled: list[bytes]) -> int:
    """Count the lines that are left when lines with comment signs, ``#`` lines and triple-quoted text are gone."""
    continued = b"\\\n" in text
    if not (continued or b"/*" in text or b"*/" in text):
        return _plain_python_code(filled)
    keep = _without_blanks if continued else list
    lines = filled
    for sign in (b"/*", b"*/"):
        if sign in text:
            lines = keep([line for line in lines if sign not in line])
    lines = keep([line for line in lines if not line.lstrip().startswith(b"#")])
    rest = b"".join([line + b"\n" for line in lines])
    if b'"""' in rest or b"'''" in rest:
        rest = _removed(_BLOCK_COMMENT, _quotes_as_comments(rest))
    code = len(_without_blanks(_split(rest))) if continued else _count_filled(rest)
    return code + (bool(filled) and filled[0].startswith(b"#!"))


def _plain_python_code(filled: list[bytes]) -> int:
    """Do what :func:`_python_code` does, three times as fast, for text without continued lines and comment signs."""
    shebang = bool(filled) and filled[0].startswith(b"#!")
    lines = [line for line in map(bytes.lstrip, filled) if line[:1] != b"#"]
    text = b"\n".join(lines)
    if b'"""' not in text and b"'''" not in text:
        return len(lines) + shebang
    pieces = _QUOTES.split(text)
    outside = [piece[:-1] if piece[-1:] in (b"u", b"U") else piece for piece in pieces[0::2]]
    if len(pieces) % 2:
        outside[-1] = pieces[-1]
    else:
        outside += [b"/*", pieces[-1]]
    return _count_filled(b"".join(outside)) + shebang


def _quotes_as_comments(text: bytes) -> bytes:
    """Turn triple quotes into ``/*`` and ``*/`` in turn."""
    inside = False

    def sign(match: re.Match[bytes]) -> bytes:
        nonlocal inside
        inside = not inside
        return b"/*" if inside else match[1] + b"*/"

    return _TRIPLE_QUOTE.sub(sign, text)


def _removed(comment: re.Pattern[bytes], text: bytes) -> bytes:
    """Remove every match of ``comment``; linear even where block comments are never closed."""
    last_end = text.rfind(b"*/")
    if text.find(b"/*", max(last_end - 1, 0)) < 0 and text.count(b"*") < MANY_STARS:
        return comment.sub(b"", text)
    line_end = b"" if comment is _CPP_COMMENT else b"\n"
    starts = re.compile(rb"/\*" if comment is _BLOCK_COMMENT else rb"/[/*]")
    pieces = []
    copied = position = 0
    while match := starts.search(text, position):
        start, position = match.span()
        if match[0] == b"//":
            end = text.find(b"\n", position) + len(line_end)
        elif position <= last_end:
            end = text.find(b"*/", position) + 2
        else:
            continue
        pieces.append(text[copied:start])
        copied = position = end
    return b"".join(pieces) + text[copied:]


def _split(text: bytes) -> list[bytes]:
    """Split into lines; like Perl's ``split``, empty ones at the end are dropped."""
    return text.rstrip(b"\n").split(b"\n") if text else []


def _count_filled(text: bytes) -> int:
    """Count the lines that hold more than white space: with that gone, line ends part nothing else."""
    return len(text.translate(None, _WHITE).split())
