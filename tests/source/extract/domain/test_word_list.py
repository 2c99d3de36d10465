import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.domain.word_list import AtLeast, Words, without_ros2, words_given
from roslens.source.extract.symbolic.text import Text


def texts(*words):
    return [Text.of(one) for one in words]


@pytest.mark.parametrize(
    ("words", "kept"),
    [
        (["a", "b"], ["a", "b"]),
        (["a", "--ros-args", "-r", "x:=y"], ["a"]),
        (["a", "--ros-args", "-r", "x:=y", "--", "b", "--ros-args"], ["a", "b"]),
        (["a", "--", "b"], ["a", "--", "b"]),
    ],
)
def test_words_without_those_of_ros(words, kept):
    assert [one.known for one in without_ros2(texts(*words))] == kept


def test_words_that_go_on():
    assert words_given(texts("a", "--ros-args")).goes_on
    assert not words_given(texts("a", "b")).goes_on
    assert not words_given([]).goes_on


COUNTS = {"<": lambda a, b: a < b, "<=": lambda a, b: a <= b, ">": lambda a, b: a > b, ">=": lambda a, b: a >= b,
          "==": lambda a, b: a == b, "!=": lambda a, b: a != b}  # fmt: skip


@given(st.integers(0, 9), st.integers(-1, 12), st.sampled_from(sorted(COUNTS)))
def test_a_comparison_is_known_where_every_number_gives_the_same(least, other, operator):
    every = {COUNTS[operator](number, other) for number in range(least, 40)}
    assert AtLeast(least).compared(operator, other) == (every.pop() if len(every) == 1 else None)


@given(st.lists(st.text(max_size=2), max_size=6), st.integers(-7, 7) | st.none(), st.integers(-7, 7) | st.none())
def test_a_part_that_is_known_is_what_any_continuation_has(words, first, last):
    part = Words(words, goes_on=True).part(first, last)
    assert Words(words).part(first, last) == words[first:last]
    if part is not None:
        for more in (["x"], ["x", "y"]):
            whole = [*words, *more][first:last]
            assert whole[: len(part)] == part
            assert part.goes_on or len(whole) == len(part)


def test_how_many_there_are():
    assert Words(["a"]).length == 1
    assert Words(["a"], goes_on=True).length == AtLeast(1)
    assert (Words(["a"]).has(-1), Words(["a"], goes_on=True).has(-1)) == (True, False)
