"""What literals of C++ mean: texts with their escapes, raw texts, numbers with suffixes, separators and bases."""

from __future__ import annotations

import re
from functools import lru_cache

_ESCAPE = re.compile(r"\\(?:\r?\n|x([0-9a-fA-F]+)|u([0-9a-fA-F]{4})|U([0-9a-fA-F]{8})|([0-7]{1,3})|(.))", re.DOTALL)
_SIMPLE = {"n": "\n", "t": "\t", "r": "\r", "0": "\0", "a": "\a", "b": "\b", "f": "\f", "v": "\v", "e": "\x1b"}
_RAW = re.compile(r'R"([^\s()\\]{0,16})\((.*)\)\1"\Z', re.DOTALL)
_WHOLE = re.compile(r"(0[xX][0-9a-fA-F]+|0[bB][01]+|[0-9]+)([uUlLzZ]*)\Z")
_DECIMAL = re.compile(r"((?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)[fFlL]?\Z")
_LAST_CODE_POINT = 0x10FFFF
_MOST_DIGITS = 400


@lru_cache(maxsize=4096)
def text_value(written: str) -> str:
    """Return the value of a string or character literal, raw or with escapes; as written if it is unterminated."""
    mark = written[-1:]
    start = written.find(mark)
    if mark not in ("'", '"') or start == len(written) - 1:
        return written
    if written[:start].endswith("R"):
        raw = _RAW.search(written, max(0, start - 1))
        return raw[2] if raw else written
    content = written[start + 1 : -1]
    return _ESCAPE.sub(_character, content) if "\\" in content else content


def _character(match: re.Match[str]) -> str:
    *codes, octal, plain = match.groups()
    for code in codes:
        if code is not None:
            return _code_point(int(code, 16))
    if octal is not None:
        return _code_point(int(octal, 8))
    return _SIMPLE.get(plain, plain) if plain is not None else ""


def _code_point(code: int) -> str:
    # A lone surrogate is no text that can be written anywhere.
    return chr(code) if code <= _LAST_CODE_POINT and not 0xD800 <= code < 0xE000 else "\N{REPLACEMENT CHARACTER}"


@lru_cache(maxsize=4096)
def number_value(written: str) -> int | float | None:
    """Return the value of a number, None of what is none: ``0x1F``, ``1'000u``, ``017``, ``1.5f``, ``1e3``."""
    plain = written.replace("'", "")
    if plain[:1] in ("-", "+"):
        value = number_value(plain[1:].lstrip())
        return -value if value is not None and plain[0] == "-" else value
    if len(plain) > _MOST_DIGITS:
        return None
    whole = _WHOLE.match(plain)
    if whole:
        digits = whole[1]
        octal = digits[0] == "0" and digits.isdigit() and len(digits) > 1
        try:
            return int(digits, 8) if octal else int(digits, 0)
        except ValueError:
            return None
    decimal = _DECIMAL.match(plain)
    if decimal:
        return float(decimal[1])
    try:
        return float.fromhex(plain.rstrip("fFlL")) if plain[:2] in ("0x", "0X") else None
    except (ValueError, OverflowError):
        return None
