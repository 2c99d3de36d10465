"""Blocks with a macro before them that takes texts: ``TEST_CASE("it works", "[tag]") {``, ``SECTION("so") {``.

The grammar knows a macro with a block only as a function, whose parameters have types. What stands between its
parentheses becomes words of the same length: ``TEST_CASE(_it_works_, _tag__) {`` is a function that is named like the
test, and inside a function a block, as it is with ``TEST(Suite, Name) {``.
"""

from __future__ import annotations

import re

from roslens.source.syntax.comments import blank_comments
from roslens.source.syntax.macro.macro_edits import arguments_of, fill

_CANDIDATE = re.compile(
    rb"(?<![\w.:>&!=(,])\b([A-Z][A-Z0-9_]{2,}(?=[ \t]*\([^()]*\")|[A-Z0-9_]*TEST_CASE[A-Z_]*(?=[ \t]*\([^()]*\())"
)
_BEFORE = re.compile(rb"(?:[;{})>:]|\A|\n[ \t]*#[^\n]*|\\)\s*\Z")
_BLOCK = re.compile(rb"\s*\{")
_FURTHER = re.compile(rb"\s*\((?=[^()]*[\w>][\s&*]+\w+\s*\))")
_NEAR = 300
_NO_WORD = re.compile(rb"[^\w\s,]|(?<=\S)[ \t]+(?=\S)")
_NESTED = re.compile(rb"\([^()]*\)|<[^<>()]*>|\{[^{}]*\}|\[[^\[\]]*\]|\"(?:[^\"\\\n]|\\.)*\"")


def name_blocks(source: bytes) -> bytes:
    """Return ``source`` with words for what such macros are given; lengths and line breaks stay."""
    if not _CANDIDATE.search(source):
        return source
    code = blank_comments(source, "cpp")
    text, done = bytearray(source), 0
    for match in _CANDIDATE.finditer(source):
        start, end = match.span(1)
        if start < done or not _BEFORE.search(code, max(0, start - _NEAR), start):
            continue
        arguments = arguments_of(source, end)
        if arguments is None or arguments[2] < 0:
            continue
        opening, _, closing = arguments
        if _BLOCK.match(code, closing + 1):
            text[opening + 1 : closing] = _words(source[opening + 1 : closing])
            done = closing
        elif _FURTHER.match(code, closing + 1):
            fill(text, opening, closing + 1)
            done = closing
    return bytes(text)


def _words(arguments: bytes) -> bytes:
    """Return arguments as words between commas: what is nested is one word."""
    while (shorter := _NESTED.sub(_one_word, arguments)) != arguments:
        arguments = shorter
    parts = [_part(part) for part in arguments.split(b",")]
    return b",".join(parts)


def _one_word(match: re.Match[bytes]) -> bytes:
    return bytes(byte if byte in b"\r\n" or _is_word(byte) else 0x5F for byte in match[0])


def _part(part: bytes) -> bytes:
    inner = part.strip()
    if not inner:
        return part[:-1] + b"_" if part else part
    word = _NO_WORD.sub(lambda match: b"_" * len(match[0]), inner)
    if word[:1].isdigit():
        word = b"_" + word[1:]
    return part.replace(inner, word, 1)


def _is_word(byte: int) -> bool:
    return byte == 0x5F or 0x30 <= byte <= 0x39 or 0x41 <= byte <= 0x5A or 0x61 <= byte <= 0x7A
