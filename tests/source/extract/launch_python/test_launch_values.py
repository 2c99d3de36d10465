"""Values of launch files in Python, as Python has them and as the interpreter has them."""

import pytest

from roslens.source.extract.domain.abstract_value import Named, Unknown
from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.launch_values import Either, as_value, lifted, plain
from roslens.source.extract.symbolic.text import Text, Written, unknown
from roslens.source.extract.transfer.budget import BudgetExceededError

NAME = Deferred("configuration", ("name",))


@pytest.mark.parametrize("value", ["a", 1, 1.5, True, None, ["a", [1]], {"a": 1, 2: "b"}, NAME])
def test_what_is_lifted_comes_back(value):
    assert plain(lifted(value)) == value


def test_a_text_with_a_hole_stays():
    text = Text.of("a", unknown("x"))
    assert plain([text, Text.of("b")]) == [text, "b"]


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (Text.of("a"), "a"),
        ([Text.of("a"), NAME], Deferred("text", ("a", NAME))),
        (1.5, "1.5"),
        (None, ""),
        (Unknown("x"), Deferred("unknown", ("x",))),
        (Named("x"), Deferred("unknown", ("the name x",))),
        (Either(Written("c"), 1, 2), Deferred("unknown", ("one of two values, by c",))),
    ],
)
def test_a_value_as_a_text_with_substitutions(value, expected):
    assert as_value(value) == expected


def test_what_is_too_large_is_refused():
    value = []
    value.append(value)
    with pytest.raises((BudgetExceededError, RecursionError)):
        plain(value)
