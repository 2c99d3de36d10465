"""The study's Halstead volume: values by hand, and the same as trying every operator in turn."""

from __future__ import annotations

from math import log2

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.tools.halstead2015 import OPERATORS, RESERVED, halstead_volume


@pytest.mark.parametrize(
    ("content", "length", "vocabulary"),
    [
        (b"int a = b + 1;", 7, 7),
        (b"a = a;", 4, 3),
        (b"x <= y", 4, 4),
        (b"x << y", 3, 3),
        (b"p->q", 3, 3),
        (b"i++", 2, 2),
        (b"a && b", 4, 3),
        (b"return x;", 3, 3),
        (b"returned x;", 3, 3),
        (b's = "//x";', 3, 3),
        (b"a // b\nc", 2, 2),
        (b"a /* b */ c", 2, 2),
        (b"a /* b\n c */ d\r\ne /* f", 3, 3),
        (b"/* a /* b\n c */ d", 2, 2),
        (b"/* a\n b /* c */ d", 1, 1),
        (b"/* a\n b /* c\n*/ d", 2, 2),
        (b"1.5f", 3, 3),
        (b"#include <a>", 4, 4),
        (b"\xff\xfe \x0b a", 2, 2),
    ],
)
def test_volume_by_hand(content: bytes, length: int, vocabulary: int):
    assert halstead_volume(content) == pytest.approx(length * log2(vocabulary), rel=1e-6)


@pytest.mark.parametrize("content", [b"", b"\n\n", b"// only a comment", b"/* x */", b"a"])
def test_nothing_to_choose_from_has_no_volume(content: bytes):
    assert halstead_volume(content) == 0


def test_volume_is_in_single_precision():
    assert halstead_volume(b"a b c") != 3 * log2(3)
    assert halstead_volume(b"a b c") == pytest.approx(3 * log2(3), rel=1e-7)


def trying_in_turn(text: bytes) -> tuple[int, int]:
    operators, operands, length = set(), set(), 0
    for piece in text.split():
        while piece:
            length += 1
            fitting = next((operator for operator in OPERATORS if piece.startswith(operator)), b"")
            if fitting:
                operators.add(fitting)
                piece = piece[len(fitting) :]
                continue
            end = min((at for operator in OPERATORS if (at := piece.find(operator)) >= 0), default=len(piece))
            word = piece[:end]
            (operators if word in RESERVED else operands).add(word)
            piece = piece[end:]
    return length, len(operators) + len(operands)


@given(st.text(alphabet="ab1 <>=&|+-.:?*!\"'\\,;{}()[]%^~#\t", max_size=60))
def test_tokens_are_what_trying_in_turn_gives(text: str):
    content = text.encode().replace(b"/", b"")
    length, vocabulary = trying_in_turn(content)
    expected = length * log2(vocabulary) if vocabulary else 0
    assert halstead_volume(content) == pytest.approx(expected, rel=1e-6)
