r"""Tokens of a file and of any part of it: Halstead's counts, names, and hashes of code lines.

A token stream in Python would cost more than the parse. So two texts are derived from the source with its
comments blanked: one where only words (names, keywords, numbers, strings) are left, one where only the marks
between them are. Splitting these at white space runs at C speed, and a run of marks such as ``();`` is cut into
operators once and remembered.

What counts (Halstead 1977 leaves it open; these are the choices of Verifysoft's CMT++, whose thresholds the
quality models use):

- *operands* are names, numbers, strings, characters and, in C++, the words of built-in types (``int``), ``this``
  and literals such as ``true``; a string is one operand however many lines it has; adjacent ones without white space
  between them are one;
- *operators* are all other keywords and all marks; a pair of ``()``, ``[]`` or ``{}`` is one operator, counted where it
  opens;
- comments, docstrings and line continuations are nothing; an ``#include`` with its target is one operand.

Known limits: ``>>`` that closes two templates is one operator; the parts of an f-string are not looked at.
"""

from __future__ import annotations

import re
from collections import Counter
from itertools import compress, count
from operator import mul
from zlib import crc32

import msgspec

from roslens.source.syntax.comments import LINE_BREAK_IN_STRING, blank_comments
from roslens.source.syntax.facts import Halstead

_WHITE = b" \t\r\v\f"
_LINES = bytes(0x0A if byte == LINE_BREAK_IN_STRING else byte for byte in range(256))


def _is_word(byte: int) -> bool:
    return byte >= 0x80 or chr(byte).isalnum() or byte in b"_$"


_WORDS = bytes(byte if _is_word(byte) else 0x20 for byte in range(256))
_MARKS = bytes(0x20 if _is_word(byte) or byte in b"\n\\" else byte for byte in range(256))
_POINT_IN_NUMBER = re.compile(rb"\.(?:(?=[0-9])|(?<=[^\w][0-9]\.)|(?<=[^\w][0-9]{2}\.))")
_MINUS_IN_NUMBER = re.compile(rb"-(?<=[0-9\xae][eE]-)(?=[0-9])")
_PLUS_IN_NUMBER = re.compile(rb"\+(?<=[0-9\xae][eE]\+)(?=[0-9])")
_POINT, _SIGN = b"\xae", b"\xad"

_CPP_KEYWORDS = frozenset(
    b"""alignas alignof and and_eq asm auto bitand bitor break case catch class co_await co_return co_yield compl
    concept const const_cast consteval constexpr constinit continue decltype default delete do dynamic_cast else enum
    explicit export extern final for friend goto if inline mutable namespace new noexcept not not_eq operator or or_eq
    override private protected public register reinterpret_cast requires return sizeof static static_assert
    static_cast struct switch template thread_local throw try typedef typeid typename union using virtual volatile
    while xor xor_eq define undef ifdef ifndef elif endif include pragma error warning line""".split()
)
_CPP_TYPE_WORDS = frozenset(
    b"""bool char char8_t char16_t char32_t double float int long short signed unsigned void wchar_t this true false
    nullptr""".split()
)
_PYTHON_KEYWORDS = frozenset(
    b"""and as assert async await break class continue def del elif else except finally for from global if import in is
    lambda nonlocal not or pass raise return try while with yield""".split()
)
KEYWORDS = {"cpp": _CPP_KEYWORDS, "python": _PYTHON_KEYWORDS}
"""Words that are operators, by syntax."""
NO_NAMES = _CPP_KEYWORDS | _CPP_TYPE_WORDS
"""Words of C++ that name nothing a program defines."""

_OPERATOR = re.compile(
    rb"<<=|>>=|<=>|\*\*=|//=|->\*?|\+\+|--|&&|\|\||[-+*/%&|^<>=!:@]=|::|<<|>>|\*\*|//|\.\.\.|\.\*|##|[^\s)\]}\\]"
)
_REMEMBERED = 20_000
_LONGEST_REMEMBERED = 16


class TokenText(msgspec.Struct, frozen=True):
    """A file ready to be counted: offsets are those of its content.

    ``code`` is the source with comments blanked, ``words`` and ``marks`` its two halves.
    """

    code: bytes
    words: bytes
    marks: bytes
    syntax: str


def token_text(code: bytes, syntax: str) -> TokenText:
    """Prepare counting; ``code`` comes from :func:`~roslens.source.syntax.comments.blank_comments`."""
    numbers = _POINT_IN_NUMBER.sub(_POINT, code)
    numbers = _MINUS_IN_NUMBER.sub(_SIGN, numbers)
    if b"e+" in code or b"E+" in code:
        numbers = _PLUS_IN_NUMBER.sub(_SIGN, numbers)
    return TokenText(code, numbers.translate(_WORDS), numbers.translate(_MARKS), syntax)


def words_of(text: TokenText, start: int = 0, end: int | None = None) -> list[bytes]:
    """Return the words between two offsets; strings are words that begin with a byte above 0x7F."""
    return text.words[start:end].split()


def word_counts(text: TokenText, start: int = 0, end: int | None = None) -> Counter[bytes]:
    """Count each word between two offsets."""
    return Counter(words_of(text, start, end))


def halstead_of(text: TokenText, words: Counter[bytes], start: int = 0, end: int | None = None) -> Halstead:
    """Count operators and operands between two offsets, whose ``words`` are known."""
    keywords = words.keys() & KEYWORDS[text.syntax]
    keyword_total = sum(map(words.__getitem__, keywords))
    runs = Counter(text.marks[start:end].split())
    distinct: set[bytes] = set().union(*map(OPERATORS.__getitem__, runs))
    total = sum(map(mul, map(len, map(OPERATORS.__getitem__, runs)), runs.values()))
    return Halstead(
        len(keywords) + len(distinct),
        len(words) - len(keywords),
        keyword_total + total,
        sum(words.values()) - keyword_total,
    )


class _Operators(dict[bytes, tuple[bytes, ...]]):
    """Runs of marks to the operators they are made of; those that are usual are remembered."""

    def __missing__(self, run: bytes) -> tuple[bytes, ...]:
        operators = tuple(_OPERATOR.findall(run))
        if len(run) < _LONGEST_REMEMBERED and len(self) < _REMEMBERED:
            self[run] = operators
        return operators


OPERATORS = _Operators()
"""Runs of marks to operators."""


def halstead(content: bytes, syntax: str) -> Halstead:
    """Count the operators and operands of a whole file.

    Args:
        content: the bytes of the file.
        syntax: ``cpp`` (also C) or ``python``.
    """
    text = token_text(blank_comments(content, syntax), syntax)
    return halstead_of(text, word_counts(text))


def line_hashes(content: bytes, syntax: str) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return a CRC-32 of each line that holds code, without its comments and white space, and the line's number."""
    return hashes_of(blank_comments(content, syntax))


def hashes_of(code: bytes) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Do what :func:`line_hashes` does for source whose comments are blanked already."""
    lines = squeezed_lines(code)
    return tuple(map(crc32, filter(None, lines))), tuple(compress(count(1), lines))


def squeezed_lines(code: bytes) -> list[bytes]:
    """Return the lines of source whose comments are blanked already, without their white space."""
    return code.translate(_LINES, _WHITE).split(b"\n")
