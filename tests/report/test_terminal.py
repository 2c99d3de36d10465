"""Text made to fit a terminal, and harmless on it."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.report.writing.terminal import Terminal, columns, left, right

PLAIN = Terminal(80, color=False, unicode=True)
ASCII = Terminal(80, color=False, unicode=False)


@pytest.mark.parametrize(
    ("text", "expected"),
    [("", 0), ("abc", 3), ("ünï", 3), ("模型", 4), ("e\u0301", 1), ("a\u200bb", 2), ("🤖", 2)],
)
def test_columns(text, expected):
    assert columns(text) == expected


def test_cut_says_that_something_is_missing():
    assert PLAIN.cut("abcdef", 6) == "abcdef"
    assert PLAIN.cut("abcdef", 5) == "abcd…"
    assert PLAIN.cut("abc def", 5) == "abc…"
    assert PLAIN.cut("模型包", 5) == "模型…"
    assert PLAIN.cut("模型包", 4) == "模…"
    assert PLAIN.cut("abc", 0) == ""
    assert ASCII.cut("abcdef", 5) == "ab..."
    assert ASCII.cut("abcdef", 2) == ".."


def test_left_and_right_count_columns():
    assert left("模", 4) == "模  "
    assert right("模", 4) == "  模"
    assert left("abcd", 2) == "abcd"


def test_wrap_ends_after_some_lines():
    assert Terminal(24, color=False, unicode=True).wrap("one two three four five six", "  ", lines=3) == [
        "  one two three four",
        "  five six",
    ]
    assert Terminal(22, color=False, unicode=True).wrap("a" * 70, "  ", lines=3) == [
        "  " + "a" * 20,
        "  " + "a" * 20,
        "  " + "a" * 19 + "…",
    ]
    assert PLAIN.wrap("", "  ") == []


@given(st.text(), st.integers(20, 90), st.integers(1, 4))
def test_wrapped_lines_fit(text, width, lines):
    terminal = Terminal(width, color=False, unicode=True)
    wrapped = terminal.wrap(terminal.clean(text), "  ", lines=lines)
    assert len(wrapped) <= lines
    assert all(columns(line) <= max(width, 22) for line in wrapped)


def test_clean_keeps_what_can_be_read():
    assert PLAIN.clean("a  b\tc\nd") == "a b c d"
    assert PLAIN.clean("ünï 模型 🤖") == "ünï 模型 🤖"
    assert ASCII.clean("ü 模") == "\\xfc \\u6a21"


def test_clean_leaves_nothing_that_is_obeyed():
    assert PLAIN.clean("\x1b[31mred\x07\x9b") == "\\x1b[31mred\\x07\\x9b"
    assert PLAIN.clean("a\u202eb\u2066c\u200fd") == "a\\u202eb\\u2066c\\u200fd"
    assert PLAIN.clean("\ud800") == "\\ud800"


def test_paint():
    colourful = Terminal(80, color=True, unicode=True)
    assert colourful.paint("x", "error") == "\x1b[1;31mx\x1b[0m"
    assert colourful.paint("", "error") == ""
    assert PLAIN.paint("x", "error") == "x"


def test_every_sign_has_an_ascii_one():
    for name in ("error", "warning", "note", "failed", "partly", "fine", "high", "none", "zero", "cut", "dot"):
        assert ASCII.glyph(name).isascii()
        assert columns(PLAIN.glyph(name)) == 1


@pytest.mark.parametrize("unicode", [True, False])
def test_a_shortened_text_fits_with_the_sign_for_what_is_missing(unicode):
    terminal = Terminal(48, color=False, unicode=unicode)
    for blank in range(40, 48):
        assert columns(terminal.shorten("a" * blank + " " + "b" * 40, 48)) <= 48
