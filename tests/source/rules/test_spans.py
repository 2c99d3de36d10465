import pytest

from roslens.source.rules.spans import indent_of, line_around, whole_lines, with_space


@pytest.mark.parametrize(
    ("text", "word", "left"),
    [
        (b"  virtual int a;", b"virtual", b"  int a;"),
        (b"void f() override\n", b"override", b"void f()\n"),
        (b"void f() override;", b"override", b"void f() ;"),
        (b"a \t b", b"a", b"b"),
        (b"a b", b"b", b"a"),
        (b"a\r\n", b"a", b"\r\n"),
    ],
)
def test_a_word_goes_with_its_blanks(text, word, left):
    start = text.index(word)
    first, last = with_space(text, start, start + len(word))
    assert text[:first] + text[last:] == left


def test_lines():
    text = b"a\n  bc\nd"
    assert [line_around(text, at) for at in (0, 3, 8)] == [(0, 2), (2, 7), (7, 8)]
    assert indent_of(text, 5) == "  "
    assert whole_lines(text, 4, 6) == (2, 7)
    assert whole_lines(text, 4, 5) == (4, 5)
