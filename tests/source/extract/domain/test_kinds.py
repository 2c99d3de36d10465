from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.domain.kinds import (
    all_of_kind,
    are_of_kind,
    first_of_kind,
    has_kind,
    is_number,
    is_whole,
    items_of,
    known_text,
)
from roslens.source.extract.symbolic.text import Hole, Text

TEXT, OPEN = Text.of("a"), Text((Hole("b"),))


def test_a_truth_value_is_no_number():
    assert [is_number(one) for one in (1, 1.5, True, TEXT)] == [True, True, False, False]
    assert [is_whole(one) for one in (1, 1.5, True, TEXT)] == [True, False, False, False]


def test_what_is_known_of_a_text_and_of_a_list():
    assert [known_text(one) for one in (TEXT, OPEN, 3, Unknown("c"))] == ["a", None, None, None]
    assert (items_of([1]), items_of((1,)), items_of(TEXT)) == ([1], [], [])


def test_values_of_a_kind():
    values = [1, TEXT, OPEN]
    assert all_of_kind(values, Text) == [TEXT, OPEN]
    assert (first_of_kind(values, Text), first_of_kind(values, Unknown)) == (TEXT, None)
    assert (has_kind(values, Text), has_kind(values, Unknown)) == (True, False)
    assert (are_of_kind(values, Text), are_of_kind(values[1:], Text)) == (False, True)
