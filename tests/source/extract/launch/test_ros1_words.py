import shlex

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.launch.ros1_words import words_of
from roslens.source.extract.symbolic.text import Hole, Text


@given(st.text("ab '\"\\\t=:", max_size=20))
def test_words_are_those_of_a_shell(text):
    try:
        wanted = shlex.split(text)
    except ValueError:
        return
    assert [one.known for one in words_of(Text.of(text))] == wanted


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (Text.of("--a ", Hole("x"), " b"), ["--a", "*", "b"]),
        (Text.of("to:=", Hole("x"), "/y"), ["to:=*/y"]),
        (Text.of("'one ", Hole("x"), "'"), ["one *"]),
        (Text(), []),
    ],
)
def test_what_is_unknown_is_part_of_a_word(text, words):
    assert [one.pattern for one in words_of(text)] == words
