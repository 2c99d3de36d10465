"""Cut tokens are those that a search between two offsets finds, wherever the cuts are."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.syntax.comments import blank_comments
from roslens.source.syntax.facts import Halstead
from roslens.source.syntax.token_cuts import TokenCuts
from roslens.source.syntax.tokens import halstead, halstead_of, token_text, word_counts, words_of

_PIECES = (
    b"if",
    b"a",
    b"bc1",
    b" ",
    b"\n",
    b"\t",
    b"(",
    b"){",
    b"}",
    b"};",
    b"::",
    b"->*",
    b"<<=",
    b">",
    b"=",
    b'"x y"',
)


def test_a_function_worked_out_by_hand():
    source = b"int a; int f() { return a; } int b;"
    start, end = source.index(b"{"), source.index(b"}") + 1
    cuts = TokenCuts(token_text(blank_comments(source, "cpp"), "cpp"), (start, end))
    assert cuts.words(start, end) == [b"return", b"a"]
    assert cuts.halstead(start, end) == Halstead(3, 1, 3, 1)
    assert cuts.halstead(0, len(source)) == halstead(source, "cpp")


@pytest.mark.parametrize("syntax", ["cpp", "python"])
@given(pieces=st.lists(st.sampled_from(_PIECES), max_size=40), bounds=st.lists(st.integers(0, 120), max_size=8))
def test_cuts_change_no_token(syntax, pieces, bounds):
    source = b"".join(pieces)
    text = token_text(blank_comments(source, syntax), syntax)
    places = sorted({0, len(source), *(bound for bound in bounds if bound <= len(source))})
    cuts = TokenCuts(text, places)
    for number, start in enumerate(places):
        for end in places[number:]:
            assert cuts.words(start, end) == words_of(text, start, end)
            assert cuts.halstead(start, end) == halstead_of(text, word_counts(text, start, end), start, end)


def test_between_offsets_that_are_no_bounds():
    text = token_text(b"ab + cd", "cpp")
    cuts = TokenCuts(text, (1,))
    assert cuts.words(1, 4) == [b"b"]
    assert cuts.halstead(1, 4) == Halstead(1, 1, 1, 1)


def test_a_bound_inside_a_string_does_not_make_two_of_it():
    source = b'f("a {b c") ; }'
    text = token_text(blank_comments(source, "cpp"), "cpp")
    body = source.index(b"{")
    cuts = TokenCuts(text, (0, len(source), body))
    assert cuts.halstead(0, len(source)) == Halstead(2, 2, 2, 2)
    assert cuts.words(0, len(source)) == words_of(text)
    assert cuts.words(body, len(source)) == words_of(text, body)
