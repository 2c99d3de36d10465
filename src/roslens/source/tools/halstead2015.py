"""Halstead's volume by the tokens of the 2016 study, with all their peculiarities.

A text is cut at ASCII white space. From the front of each piece the first of :data:`OPERATORS` that fits is taken, else
everything up to the next one: a reserved word is an operator, anything else an operand. Comments are taken out line by
line before, without regard to strings.
"""

from __future__ import annotations

import re
from math import log2
from struct import pack, unpack

# In the order in which they are tried: `<=` comes after `<` and is never reached, so it is two tokens.
OPERATORS = (
    b"::", b"++", b"--", b"(", b")", b"[", b"]", b".", b"->", b"+", b"-", b"!", b"~", b"*", b"&", b"/", b"%", b"<<",
    b">>", b"<", b">", b"==", b"=", b"^", b"|", b"?:", b",", b'"', b"'", b"\\", b";", b"{", b"}",
)  # fmt: skip

RESERVED = frozenset(
    b"""alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t class compl const
    constexpr const_cast continue decltype default delete do double dynamic_cast else enum explicit export extern false
    float for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private
    protected public register reinterpret_cast return short signed sizeof static static_assert static_cast struct switch
    template this thread_local throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t
    while xor xor_eq""".split()
)

_OPERATOR = b"|".join(re.escape(operator) for operator in OPERATORS)
_TOKEN = re.compile(b"(?P<operator>" + _OPERATOR + b")|(?:(?!" + _OPERATOR + b").)+", re.DOTALL)


def halstead_volume(content: bytes) -> float:
    """Return N log2 n of a file's content, rounded to single precision as the study's database did; 0 when empty."""
    operators: set[bytes] = set()
    operands: set[bytes] = set()
    length = 0
    for line in _without_comments(content.splitlines()):
        for piece in line.split():
            for match in _TOKEN.finditer(piece):
                token = match[0]
                (operators if match["operator"] or token in RESERVED else operands).add(token)
                length += 1
    vocabulary = len(operators) + len(operands)
    volume = length * log2(vocabulary) if vocabulary else 0.0
    return float(unpack("f", pack("f", volume))[0])


def _without_comments(lines: list[bytes]) -> list[bytes]:
    kept: list[bytes] = []
    inside = False
    for line in lines:
        parts: list[bytes] = []
        rest = line
        while rest:
            rest, inside = _reduce(rest, parts, inside=inside)
        kept.append(b" ".join(parts))
    return kept


def _reduce(line: bytes, parts: list[bytes], *, inside: bool) -> tuple[bytes, bool]:
    """Move the code before the next comment mark to ``parts``; return what is behind the mark."""
    begin, end, rest_of_line = line.find(b"/*"), line.find(b"*/"), line.find(b"//")
    if not inside and rest_of_line >= 0 and (begin < 0 or rest_of_line < begin):
        parts.append(line[:rest_of_line])
        return b"", False
    if inside and end >= 0:
        return line[end + 2 :], False
    if begin >= 0:
        parts.append(line[:begin])
        return line[begin + 2 :], True
    if not inside:
        parts.append(line)
    return b"", inside
